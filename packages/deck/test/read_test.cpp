#include "deck_fixture.hpp"

#include <culm_kit/temporary_folder.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace culm::deck {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A folder of files for one test.
class Files : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_ / "parts"); }

  std::string write(const std::string& name, const std::string& text) {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string mistakes_of(const std::string& path) const {
    try {
      Deck::parse_file(path).validate(world());
      return "";
    } catch (const InputError& error) {
      // The folder is another one on each machine.
      std::string text = error.what();
      for (auto at = text.find(folder_.path().string()); at != std::string::npos;
           at = text.find(folder_.path().string())) {
        text.erase(at, folder_.path().string().size() + 1);
      }
      return text;
    }
  }

  kit::TemporaryFolder folder_;
};

TEST(Read, TruncatedFilesGiveOneMessageWithItsLine) {
  const std::string whole = deck_around(body());
  for (std::size_t size = 1; size + 2 < whole.size(); ++size) {
    const std::string text = mistakes(whole.substr(0, size));
    EXPECT_THAT(text, StartsWith("deck.xml:")) << size;
    EXPECT_THAT(text, HasSubstr(": not well-formed XML: ")) << size;
    EXPECT_EQ(text.find('\n'), std::string::npos) << size;
  }
}

TEST(Read, AnUnclosedListNamesTheLine) {
  EXPECT_EQ(mistakes("<ParameterList name=\"culm\">\n<ParameterList name=\"a\">\n"),
            "deck.xml:3: not well-formed XML: Premature end of data in tag ParameterList line 2");
}

TEST(Read, BinaryFilesAreRefused) {
  EXPECT_EQ(mistakes(std::string("<a>\n\0\x7f", 6)),
            "deck.xml:2: not a text file: there is a zero byte in it");
  EXPECT_THAT(mistakes("\x89PNG\r\n\x1a\n"), StartsWith("deck.xml:1: not well-formed XML: "));
  EXPECT_THAT(mistakes("<ParameterList name=\"\xff\xfe\"/>"),
              StartsWith("deck.xml:1: not well-formed XML: "));
}

TEST(Read, HugeNestingIsRefusedAndDoesNotCrash) {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "<ParameterList name=\"a\">\n";
  EXPECT_EQ(mistakes(text), "deck.xml:65: lists are nested deeper than 64 levels");
}

TEST(Read, HugeNestingOfParenthesesIsRefusedAndDoesNotCrash) {
  const std::string value = std::string(200000, '(') + "1";
  EXPECT_NE(mistakes(deck_around(beam("<Parameter name=\"Length\" value=\"" + value + "\"/>"))),
            "");
}

TEST(Read, DocumentTypesAreRefused) {
  const std::string bomb =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\">\n"
      "<!ENTITY b \"&a;&a;&a;&a;&a;&a;\">]>\n<ParameterList name=\"&b;\"/>";
  EXPECT_EQ(mistakes(bomb), "deck.xml:2: a DOCTYPE is not allowed in a deck");
  EXPECT_EQ(mistakes("<!DOCTYPE x SYSTEM \"http://127.0.0.1/x.dtd\">\n<ParameterList/>"),
            "deck.xml:1: a DOCTYPE is not allowed in a deck");
}

TEST(Read, UnknownEntitiesAreRefused) {
  EXPECT_THAT(mistakes("<ParameterList name=\"&what;\"/>"), HasSubstr("Entity 'what'"));
}

TEST(Read, TheFiveEntitiesOfXmlAndCharacterReferencesAreText) {
  const Options deck = read(
      "<ParameterList name=\"culm\"><ParameterList name=\"Structures\"/>"
      "<Parameter name=\"Title\" value=\"&lt;a &amp; &#98;&gt; ü\"/>"
      "</ParameterList>");
  EXPECT_EQ(deck.text("Title"), "<a & b> ü");
}

TEST(Read, AByteOrderMarkAndWindowsLineEndsAreHarmless) {
  EXPECT_EQ(mistakes("\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"UTF-8\"?>\r\n"
                     "<ParameterList name=\"culm\">\r\n<ParameterList name=\"Structures\"/>\r\n"
                     "</ParameterList>\r\n"),
            "");
}

TEST(Read, ATagOfManyLinesIsNamedByItsFirst) {
  EXPECT_EQ(mistakes(deck_around(beam("\n<Parameter\n  name=\"Length\"\n  value=\"-1\"\n/>"))),
            "deck.xml:4: Structures / beam / Length: must be > 0 m, got -1");
}

TEST(Read, LinesAreCountedBeyondSixtyFiveThousand) {
  EXPECT_EQ(mistakes(deck_around(std::string(100000, '\n') +
                                 beam("<Parameter name=\"Length\" value=\"-1\"/>"))),
            "deck.xml:100003: Structures / beam / Length: must be > 0 m, got -1");
}

TEST(Read, OnlyTheElementsOfADeckAreAllowed) {
  EXPECT_EQ(mistakes(deck_around("<ParameterLst name=\"x\"><Parameter name=\"Type\" "
                                 "value=\"Beem\"/></ParameterLst>\n<beam/>\nwords\n\n")),
            "deck.xml:3: Structures: unknown element <ParameterLst> – did you mean "
            "'ParameterList'?\n"
            "deck.xml:3: Structures / x / Type: unknown type 'Beem' – did you mean 'Beam'?\n"
            "deck.xml:4: Structures: unknown element <beam> (allowed: ParameterList, Parameter, "
            "Variable, xi:include)\n"
            "deck.xml:5: Structures: text between elements is not allowed: 'words'");
}

TEST(Read, OnlyTheAttributesOfADeckAreAllowed) {
  EXPECT_EQ(mistakes(deck_around(body("\n<Parameter nam=\"Fixed\" value=\"true\"/>"
                                      "\n<Parameter name=\"Position\"/>"))),
            "deck.xml:4: Structures / top / Fixed: unknown attribute 'nam' of <Parameter> – did "
            "you mean 'name'?\n"
            "deck.xml:5: Structures / top / Position: has no attribute 'value'");
}

TEST(Read, OneMistakeOfFormGivesOneMessage) {
  const auto beam_of = [](const std::string& length) {
    return mistakes(deck_around(beam("\n" + length)));
  };
  const std::string place = "deck.xml:4: Structures / beam";
  EXPECT_EQ(beam_of("<Parameter name=\"Length\" val=\"2\"/>"),
            place +
                " / Length: unknown attribute 'val' of <Parameter> (allowed: name, value, type, "
                "unit, isDefault)");
  EXPECT_EQ(beam_of("<Parameter id=\"Length\" value=\"2\"/>"),
            place +
                ": unknown attribute 'id' of <Parameter> (allowed: name, value, type, unit, "
                "isDefault)");
  EXPECT_EQ(beam_of("<Parameter value=\"2\"/>"), place + ": <Parameter> has no attribute 'name'");
  EXPECT_EQ(beam_of("<Paramter name=\"Length\" value=\"2\"/>"),
            place + ": unknown element <Paramter> – did you mean 'Parameter'?");
  EXPECT_EQ(beam_of("<number name=\"Length\" value=\"2\"/>"),
            place +
                ": unknown element <number> (allowed: ParameterList, Parameter, Variable, "
                "xi:include)");
}

TEST(Read, MistakesOfFormAndOfContentComeTogether) {
  EXPECT_EQ(mistakes(deck_around("<beam/>\n" + body("<Parameter name=\"Fixd\" value=\"true\"/>"))),
            "deck.xml:3: Structures: unknown element <beam> (allowed: ParameterList, Parameter, "
            "Variable, xi:include)\n"
            "deck.xml:4: Structures / top: unknown name 'Fixd' – did you mean 'Fixed'?");
}

TEST_F(Files, AMissingFileIsAFileError) {
  EXPECT_THROW(Deck::parse_file(path("none.xml")), FileError);
  EXPECT_THROW(Deck::parse_file(folder_.path().string()), FileError);
  EXPECT_THROW(Deck::parse_file(write("empty.xml", "")), FileError);
  EXPECT_THROW(Deck::parse_file(write("blank.xml", " \n")), FileError);
  try {
    Deck::parse_file("none.xml");
    FAIL() << "nothing was thrown";
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "none.xml: there is no such file");
  }
}

TEST_F(Files, AnIncludedListOfAnotherNameBecomesAChild) {
  write("parts/top.xml", body());
  const auto deck =
      Deck::parse_file(write("deck.xml", deck_around("<xi:include href=\"parts/top.xml\"/>")));
  EXPECT_EQ(deck.validate(world()).list("Structures").list("top").number("Mass"), 15.0);
}

TEST_F(Files, TheContentOfAnIncludedListOfTheSameNameIsSpliced) {
  write("parts/all.xml", "<ParameterList name=\"Structures\">" + body() + "</ParameterList>");
  const auto deck = Deck::parse_file(
      write("deck.xml", deck_around("<x:include xmlns:x=\"http://www.w3.org/2001/XInclude\" "
                                    "href=\"parts/all.xml\"/>")));
  EXPECT_EQ(deck.validate(world()).list("Structures").entries().size(), 1U);
}

TEST_F(Files, IncludesAreRelativeToTheIncludingFile) {
  write("parts/outer.xml",
        "<ParameterList name=\"Structures\"><xi:include href=\"inner.xml\"/></ParameterList>");
  write("parts/inner.xml", body());
  EXPECT_EQ(mistakes_of(write("deck.xml", deck_around("<xi:include href=\"parts/outer.xml\"/>"))),
            "");
}

TEST_F(Files, MistakesInAnIncludedFileNameThatFile) {
  write("parts/top.xml", "\n\n" + body("<Parameter name=\"Fixed\" value=\"no\"/>"));
  EXPECT_EQ(mistakes_of(write("deck.xml", deck_around("<xi:include href=\"parts/top.xml\"/>"))),
            "parts/top.xml:3: Structures / top / Fixed: must be true or false, got 'no'");
}

TEST_F(Files, AnIncludeThatCannotBeReadIsReportedAtItsLine) {
  EXPECT_EQ(mistakes_of(write("deck.xml", deck_around("<xi:include href=\"none.xml\"/>\n"
                                                      "<xi:include href=\"parts\"/>"))),
            "deck.xml:3: Structures: cannot read the included file 'none.xml': there is "
            "no such file\n"
            "deck.xml:4: Structures: cannot read the included file 'parts': is a folder");
}

TEST_F(Files, WhatABrokenIncludeMayHoldIsNotMissed) {
  EXPECT_EQ(mistakes_of(write("deck.xml",
                              "<ParameterList name=\"culm\">\n<xi:include href=\"none.xml\"/>\n"
                              "</ParameterList>")),
            "deck.xml:2: cannot read the included file 'none.xml': there is no such file");
}

TEST_F(Files, ABrokenIncludeDoesNotHideOtherMistakes) {
  write("parts/top.xml", "<ParameterList name=\"top\">");
  EXPECT_EQ(mistakes_of(write("deck.xml", deck_around("<xi:include href=\"parts/top.xml\"/>\n"
                                                      "<ParameterList name=\"x\"/>"))),
            "parts/top.xml:1: not well-formed XML: Premature end of data in tag ParameterList "
            "line 1\n"
            "deck.xml:4: Structures / x: missing 'Type' (allowed: Beam, Rigid Body)");
}

TEST_F(Files, CyclesAreFound) {
  write("parts/a.xml",
        "<ParameterList name=\"Structures\">\n<xi:include href=\"b.xml\"/></ParameterList>");
  write("parts/b.xml",
        "<ParameterList name=\"Structures\">\n<xi:include href=\"./a.xml\"/></ParameterList>");
  EXPECT_EQ(mistakes_of(write("deck.xml", deck_around("<xi:include href=\"parts/a.xml\"/>"))),
            "parts/b.xml:2: Structures: 'parts/a.xml' includes itself: deck.xml → parts/a.xml → "
            "parts/b.xml → parts/a.xml");
}

TEST_F(Files, DuplicatesAcrossFilesNameTheFirst) {
  write("parts/top.xml", body());
  EXPECT_EQ(mistakes_of(
                write("deck.xml", deck_around("<xi:include href=\"parts/top.xml\"/>\n" + body()))),
            "deck.xml:4: Structures / top: duplicate name, first used at parts/top.xml:1");
}

TEST_F(Files, AllRanksCanParseWhatOneHasRead) {
  write("parts/top.xml", body("<Parameter name=\"Fixed\" value=\"no\"/>"));
  const std::string path = write("deck.xml", deck_around("<xi:include href=\"parts/top.xml\"/>\n"
                                                         "<xi:include href=\"none.xml\"/>"));
  const std::vector<DeckText> texts = Deck::read_files(path);
  ASSERT_EQ(texts.size(), 3U);
  EXPECT_EQ(texts[2].objection, "there is no such file");
  const auto complaint = [](const Deck& deck) -> std::string {
    try {
      deck.validate(world());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string expected = complaint(Deck::parse_file(path));
  EXPECT_THAT(expected, HasSubstr("must be true or false, got 'no'"));
  EXPECT_THAT(expected, HasSubstr("cannot read the included file"));
  std::filesystem::remove_all(folder_.path());
  EXPECT_EQ(complaint(Deck::parse_texts(texts)), expected);
}

TEST_F(Files, ReadFilesLeavesBrokenXmlToTheParser) {
  EXPECT_EQ(Deck::read_files(write("deck.xml", "<a>")).size(), 1U);
  EXPECT_THROW(Deck::read_files(path("none.xml")), FileError);
}

}  // namespace
}  // namespace culm::deck
