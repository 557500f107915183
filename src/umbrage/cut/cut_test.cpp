#include <gtest/gtest.h>
TEST(Cut, placeholder) {}
