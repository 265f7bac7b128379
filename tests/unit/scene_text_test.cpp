// The helpers below the readers: messages, numbers, plain lines, whole files.

#include <gtest/gtest.h>

#include <cmath>

#include "src/scene/messages.h"
#include "src/scene/numbers.h"
#include "src/scene/obj_lines.h"
#include "src/scene/text_file.h"
#include "tests/unit/scene_folder.h"

namespace lemma {
namespace {

using Numbers = std::vector<double>;

TEST(Messages, PositionShowsWhatIsKnown) {
  EXPECT_EQ(to_string({"a.xml"}), "a.xml");
  EXPECT_EQ(to_string({"a.xml", 3}), "a.xml:3");
  EXPECT_EQ(to_string({"a.xml", 3, 9}), "a.xml:3:9");
  EXPECT_EQ(to_string({"a.xml", 0, 9}), "a.xml");
}

TEST(Messages, ErrorHasTheHintOnItsOwnLine) {
  EXPECT_STREQ(SceneError({"a.xml", 3, 9}, "what", "instead").what(),
               "a.xml:3:9: error: what\n  hint: instead");
  EXPECT_STREQ(SceneError({"a.xml"}, "what", "").what(), "a.xml: error: what");
}

TEST(Messages, Warning) {
  Warnings warnings;
  warn(warnings, {"a.obj", 7}, "odd");
  EXPECT_EQ(warnings, Warnings{"a.obj:7: warning: odd"});
}

TEST(Messages, QuotedTextIsShortAndOnOneLine) {
  EXPECT_EQ(in_quotes("a\nb"), "\"a b\"");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "\"" + std::string(60, 'x') + "...\"");
}

TEST(Messages, NamesAreCutAfterEight) {
  EXPECT_EQ(join_names({}), "");
  EXPECT_EQ(join_names({"a", "b"}), "a, b");
  EXPECT_EQ(join_names(std::vector<std::string>(10, "a")), "a, a, a, a, a, a, a, a and 2 more");
}

TEST(ParseNumbers, TakesAllSeparatorsOfTheSceneFiles) {
  EXPECT_EQ(parse_numbers("300,300,300"), (Numbers{300, 300, 300}));
  EXPECT_EQ(parse_numbers("34.0, 24.0, 8.0"), (Numbers{34, 24, 8}));
  EXPECT_EQ(parse_numbers(" \t2.7,\n   2.1 ,\r\n 0.9  "), (Numbers{2.7, 2.1, 0.9}));
  EXPECT_EQ(parse_numbers("1 2 3"), (Numbers{1, 2, 3}));
  EXPECT_EQ(parse_numbers("+1 -2 .5 1e-3"), (Numbers{1, -2, .5, 1e-3}));
  EXPECT_EQ(parse_numbers(""), Numbers{});
}

TEST(ParseNumbers, NanAndInfinityAreNumbers) {
  const auto numbers = parse_numbers("nan, -inf");
  ASSERT_TRUE(numbers && numbers->size() == 2);
  EXPECT_TRUE(std::isnan((*numbers)[0]));
  EXPECT_TRUE(std::isinf((*numbers)[1]));
}

TEST(ParseNumbers, RefusesTheRest) {
  for (const char* text : {"abc", "1,,2", "1,2,", ",1", "1;2", "1.5x", "1e999", "-", "+", "0x10", "1-2"}) {
    EXPECT_EQ(parse_numbers(text), std::nullopt) << text;
  }
}

TEST(PlainLines, LineEndsBlanksAndCommentsGo) {
  EXPECT_EQ(plain_lines("v 1 2 3\r\n  usemtl \t white  \rf 1 2 3"), "v 1 2 3\nusemtl white\nf 1 2 3\n");
  EXPECT_EQ(plain_lines("# all\n\nv 1 2 3 # tail\nf 1 2 3# tail\n"), "\n\nv 1 2 3\nf 1 2 3\n");
}

TEST(PlainLines, NamesKeepTheirHashAndTheirBlanks) {
  EXPECT_EQ(plain_lines("newmtl a#1  b # remark\n"), "newmtl a#1  b\n");
}

TEST(PlainLines, ContinuedLinesAreJoinedAndCountedStill) {
  EXPECT_EQ(plain_lines("f 1 2 \\\n  3 \\\r\n 4\nv 1"), "f 1 2  3  4\n\n\nv 1\n");
  EXPECT_EQ(plain_lines("f 1 2\\"), "f 1 2\n");
}

TEST(LineCursor, GivesKeywordRestAndNumber) {
  const std::string text = plain_lines("\n\nusemtl a b\ng\n");
  LineCursor cursor(text);
  const auto first = cursor.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->keyword, "usemtl");
  EXPECT_EQ(first->rest, "a b");
  EXPECT_EQ(first->number, 3);
  const auto second = cursor.next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->keyword, "g");
  EXPECT_EQ(second->rest, "");
  EXPECT_FALSE(cursor.next());
}

TEST(TextFile, DropsTheByteOrderMark) {
  const test::SceneFolder folder;
  EXPECT_EQ(read_text_file(folder.write("a", "\xEF\xBB\xBFtext")), "text");
}

TEST(TextFile, Errors) {
  const test::SceneFolder folder;
  const auto error = [&](const std::filesystem::path& file) {
    return folder.error_of([&] { (void)read_text_file(file); });
  };
  EXPECT_EQ(error(folder.path() / "none"), "FOLDER/none: error: no such file\n  hint: check the name");
  EXPECT_EQ(error(folder.path()), "FOLDER: error: this is no file\n  hint: name a file");
  EXPECT_EQ(error(folder.write("empty", "")), "FOLDER/empty: error: the file is empty");
  EXPECT_EQ(error(folder.write("binary", std::string_view("a\nb\0c", 5))),
            "FOLDER/binary:2: error: the file holds zero bytes: it is no text in UTF-8\n"
            "  hint: save it as UTF-8, without compression");
}

}  // namespace
}  // namespace lemma
