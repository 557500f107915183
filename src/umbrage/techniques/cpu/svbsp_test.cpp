#include <gtest/gtest.h>
TEST(Svbsp, placeholder) {}
