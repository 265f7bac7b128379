// The helpers below the readers: messages, numbers, plain lines, whole files.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/scene/messages.h"
#include "src/scene/numbers.h"
#include "src/scene/obj_lines.h"
#include "src/scene/text_file.h"
#include "src/scene/texture_name.h"
#include "src/scene/utf8.h"
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

/// "number:keyword|rest" of all lines.
std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  LineCursor cursor(text);
  while (const auto line = cursor.next()) {
    lines.push_back(fmt::format("{}:{}|{}", line->number, line->keyword, line->rest));
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(LineCursor, LineEndsBlanksAndCommentsGo) {
  EXPECT_EQ(lines_of("v 1 2 3\r\n  usemtl \t white  \rf 1 2 3"),
            (Lines{"1:v|1 2 3", "2:usemtl|white", "3:f|1 2 3"}));
  EXPECT_EQ(lines_of("# all\n\nv 1 2 3 # tail\nf 1 2 3# tail\n"), (Lines{"3:v|1 2 3", "4:f|1 2 3"}));
  EXPECT_EQ(lines_of("a\r\rb\r"), (Lines{"1:a|", "3:b|"}));
}

TEST(LineCursor, NamesKeepTheirHashAndTheirBlanks) {
  EXPECT_EQ(lines_of("newmtl a#1  b # remark\n"), Lines{"1:newmtl|a#1  b"});
}

TEST(LineCursor, ContinuedLinesAreJoinedAndCountedStill) {
  EXPECT_EQ(lines_of("f 1 2 \\\n  3 \\\r\n 4#x\nv 1"), (Lines{"1:f|1 2  3  4", "4:v|1"}));
  EXPECT_EQ(lines_of("f 1 2\\"), Lines{"1:f|1 2"});
  EXPECT_EQ(lines_of("\\\n\\\n"), Lines{});
}

TEST(LineCursor, GivesKeywordRestAndNumber) {
  const std::string text = "\n\nusemtl a b\ng\n";
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

TEST(TextureName, StandsBehindTheOptions) {
  EXPECT_EQ(texture_name("wood 5.jpg"), "wood 5.jpg");
  EXPECT_EQ(texture_name("-s 1 1 1 wood 5.jpg"), "wood 5.jpg");
  EXPECT_EQ(texture_name("-o 0.1 a.jpg"), "a.jpg") << "numbers may be fewer";
  EXPECT_EQ(texture_name("-blendu on -mm 0 1 \t a b.jpg"), "a b.jpg");
  EXPECT_EQ(texture_name("-texres 512 -clamp on -colorspace sRGB input.jpg"), "input.jpg");
  EXPECT_EQ(texture_name("-s 1 2 3 4.jpg"), "4.jpg");
  EXPECT_EQ(texture_name("-unknown a.jpg"), "-unknown a.jpg");
  EXPECT_EQ(texture_name("-s 1 1"), "");
  EXPECT_EQ(texture_name(""), "");
}

TEST(Utf8, FindsTheFirstByteThatBelongsToNothing) {
  EXPECT_EQ(find_invalid_utf8("plain text of many bytes"), std::nullopt);
  EXPECT_EQ(find_invalid_utf8("\u00e9 \u20ac \U0001F600 \uFFFD \U0010FFFF"), std::nullopt);
  EXPECT_EQ(find_invalid_utf8("nine byte\xE9s"), 9u) << "Latin-1";
  for (const std::string_view bad :
       {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xE2\x82", "\xC3"}) {
    EXPECT_EQ(find_invalid_utf8(std::string("a").append(bad)), 1u);
  }
}

TEST(Messages, QuotedTextIsUtf8) {
  EXPECT_EQ(in_quotes("caf\xE9"), "\"caf?\"");
  EXPECT_EQ(in_quotes(std::string(59, 'x') + "\u20ac"), "\"" + std::string(59, 'x') + "...\"");
}

class TextFile : public testing::Test {
 protected:
  std::string read(const std::filesystem::path& file) { return read_text_file(file, 100, warnings_); }
  std::string error(const std::filesystem::path& file) {
    return folder_.error_of([&] { (void)read(file); });
  }

  test::SceneFolder folder_;
  Warnings warnings_;
};

TEST_F(TextFile, DropsTheByteOrderMark) {
  EXPECT_EQ(read(folder_.write("a", "\xEF\xBB\xBFtext")), "text");
}

TEST_F(TextFile, Errors) {
  EXPECT_EQ(error(folder_.path() / "none"), "FOLDER/none: error: no such file\n  hint: check the name");
  EXPECT_EQ(error(folder_.path()), "FOLDER: error: this is no file\n  hint: name a file");
  EXPECT_EQ(error("/dev/zero"), "/dev/zero: error: this is no file\n  hint: name a file");
  EXPECT_EQ(error(folder_.write("empty", "")), "FOLDER/empty: error: the file is empty");
  EXPECT_EQ(error(folder_.write("mark", "\xEF\xBB\xBF")), "FOLDER/mark: error: the file is empty");
  EXPECT_EQ(error(folder_.write("binary", std::string_view("a\nb\0c", 5))),
            "FOLDER/binary:2: error: the file holds zero bytes: it is no text in UTF-8\n"
            "  hint: save it as UTF-8, without compression");
}

TEST_F(TextFile, LargeFilesAreRefusedBeforeTheyAreRead) {
  const std::filesystem::path file = folder_.write("large", "x");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40);  // takes no room: one hole
  EXPECT_EQ(error(file),
            "FOLDER/large: error: the file has 1099511.6 MB; at most 0.0 MB are read\n"
            "  hint: check that it is the right file, or divide it");
}

TEST_F(TextFile, OtherEncodingsAreWarnedOf) {
  EXPECT_EQ(read(folder_.write("latin1", "a\nn\xE4me")), "a\nn\xE4me");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(folder_.plain(warnings_[0]),
            "FOLDER/latin1:2: warning: this is no UTF-8; names are compared byte by byte");
}

}  // namespace
}  // namespace lemma
