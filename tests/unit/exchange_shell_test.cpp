// Words for a shell: each comes back as one word, the same, from a shell itself.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "exchange/shell_text.hpp"

namespace {

using tanktread::exchange::shell_text;

/// What a shell's command makes of a word; a '.' after it shows that it ends there.
std::string through_shell(const std::string& text) {
  FILE* pipe = popen(("printf '%s.' " + text).c_str(), "r");
  std::array<char, 256> buffer{};
  const auto size = std::fread(buffer.data(), 1, buffer.size(), pipe);
  pclose(pipe);
  return {buffer.data(), size};
}

TEST(ShellText, IsOneWordToAShell) {
  for (const std::string word : {"output/shear-capsule", "r/my run", "it's", "a\"b", "$HOME", "~", "a;b", "*",
                                 "", "two\nlines", "back\\slash", "-x=1,2", "`id`", "(a)",
                                 "Gr\xc3\xb6\xc3\x9f"
                                 "e",
                                 "#a", "!x"}) {
    EXPECT_EQ(through_shell(shell_text(word)), word + ".");
  }
}

TEST(ShellText, LeavesHarmlessWordsAsTheyAre) {
  EXPECT_EQ(shell_text("output/shear-capsule_2.a"), "output/shear-capsule_2.a");
  EXPECT_EQ(shell_text("r/my run"), "'r/my run'");
}

}  // namespace
