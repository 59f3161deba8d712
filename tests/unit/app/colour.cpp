#include "engine/app/terminal/colour.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace colour_test {

ColourFacts terminal() { return {true, "", "", "xterm"}; }
ColourFacts pipe() { return {false, "", "", "xterm"}; }

TEST(Colour, FollowsTheTerminal) {
  EXPECT_TRUE(use_colour(ColourChoice::automatic, terminal()));
  EXPECT_FALSE(use_colour(ColourChoice::automatic, pipe()));
  EXPECT_FALSE(use_colour(ColourChoice::automatic, {true, "", "", "dumb"}));
}

TEST(Colour, NoColorBeatsClicolorForceAndTheTerminal) {
  EXPECT_FALSE(use_colour(ColourChoice::automatic, {true, "1", "", "xterm"}));
  EXPECT_FALSE(use_colour(ColourChoice::automatic, {true, "1", "1", "xterm"}));
}

TEST(Colour, ClicolorForceBeatsAPipeUnlessItIsZero) {
  EXPECT_TRUE(use_colour(ColourChoice::automatic, {false, "", "1", "dumb"}));
  EXPECT_FALSE(use_colour(ColourChoice::automatic, {false, "", "0", "xterm"}));
}

TEST(Colour, TheOptionBeatsEverything) {
  EXPECT_TRUE(use_colour(ColourChoice::always, {false, "1", "", "dumb"}));
  EXPECT_FALSE(use_colour(ColourChoice::never, {true, "", "1", "xterm"}));
}

TEST(Ink, ThatIsOffChangesNothing) {
  Ink const off;
  EXPECT_EQ(off.bold("a") + off.error("b") + off.warning("c") + off.name("d"), "abcd");
}

TEST(Ink, EndsWhatItBegins) {
  EXPECT_EQ(Ink(true).bold("word"), "\x1b[1mword\x1b[0m");
  EXPECT_EQ(Ink(true).bold(""), "");
}

}  // namespace colour_test
}  // namespace torquescope
