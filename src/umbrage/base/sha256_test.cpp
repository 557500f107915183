#include "umbrage/base/sha256.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace umbrage {
namespace {

std::string hashOf(const std::string& text) { return sha256(std::as_bytes(std::span(text))); }

// The examples of FIPS 180-4, and lengths around a block's padding.
TEST(Sha256, knownHashes) {
  EXPECT_EQ(hashOf(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hashOf("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hashOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hashOf(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, filesAreReadInPieces) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1} << 20, (std::size_t{3} << 20) + 17}) {
    const std::string text(size, 'x');
    const auto path = std::filesystem::temp_directory_path() / ("umbrage-sha-" + std::to_string(size));
    std::ofstream(path, std::ios::binary) << text;
    EXPECT_EQ(sha256OfFile(path).value_or(""), hashOf(text));
    std::filesystem::remove(path);
  }
  EXPECT_FALSE(sha256OfFile("/nowhere/at/all"));
}

}  // namespace
}  // namespace umbrage
