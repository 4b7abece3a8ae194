// Files that are cut or have a flipped bit: a message, or a deck with all that the file still
// holds.
#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/openfast/import.hpp>

#include "offshore_files.hpp"
#include "sample_files.hpp"
#include "sample_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <sstream>

namespace culm::openfast {
namespace {

class DamagedFiles : public SampleFiles {
 protected:
  DamagedFiles() {
    for (const auto& [name, text] : scene_files()) files_[name] = write(name, text);
    scene_ = files_.at("scene.fst");
    whole_ = import_file(scene_);
  }

  // Nothing if the file is refused with a message. Any other exception is a bug, and ends the test.
  std::optional<Imported> import_with(const std::string& name, const std::string& text) {
    write(name, text);
    try {
      return import_file(scene_);
    } catch (const Error& error) {
      EXPECT_FALSE(std::string(error.what()).empty());
      return std::nullopt;
    }
  }

  static std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
      ++found;
    }
    return found;
  }

  // Whether the report has a line that the report of the whole files does not have.
  bool says_more(const Imported& made) const {
    const auto lines_of = [](const std::string& text) {
      std::istringstream stream(text);
      std::set<std::string> lines;
      for (std::string line; std::getline(stream, line);) lines.insert(line);
      return lines;
    };
    const auto before = lines_of(whole_.report), now = lines_of(made.report);
    return !std::includes(before.begin(), before.end(), now.begin(), now.end());
  }

  // Whether something is missing from the deck: a list, or a number of one. A digit that is another
  // one by the flip makes another number, for which an array may have fewer places.
  bool has_less(const Imported& made, bool is_other_number) const {
    const auto lost = [&](const char* part) {
      return count(made.deck, part) < count(whole_.deck, part);
    };
    return lost("<ParameterList") || lost("<Parameter ") || (!is_other_number && lost(", "));
  }

  void expect_cuts_to_be_told() {
    for (const auto& [name, path] : files_) {
      const std::string text = read_file(path);
      for (std::size_t percent = 0; percent < 100; percent += 5) {
        const auto made = import_with(name, text.substr(0, text.size() * percent / 100));
        if (!made || made->deck == whole_.deck || says_more(*made)) continue;
        ADD_FAILURE() << name << " cut at " << percent << " %: another deck without a word";
      }
      write(name, text);
    }
  }

  void expect_flips_to_be_told(int flips) {
    std::mt19937 generator(1);
    for (const auto& [name, path] : files_) {
      const std::string text = read_file(path);
      for (int i = 0; i < flips; ++i) {
        std::string damaged = text;
        const std::size_t place = generator() % text.size();
        const unsigned bit = generator() % 8;
        damaged[place] =
            static_cast<char>(static_cast<unsigned char>(damaged[place]) ^ (1U << bit));
        const auto made = import_with(name, damaged);
        const bool is_other_number = std::isdigit(static_cast<unsigned char>(text[place])) != 0 &&
                                     std::isdigit(static_cast<unsigned char>(damaged[place])) != 0;
        if (!made || !has_less(*made, is_other_number) || says_more(*made)) continue;
        ADD_FAILURE() << name << ", bit " << bit << " of byte " << place << " ('" << text[place]
                      << "') flipped: a deck without a word";
      }
      write(name, text);
    }
  }

  std::map<std::string, std::filesystem::path> files_;
  std::filesystem::path scene_;
  Imported whole_;
};

TEST_F(DamagedFiles, ThatAreCutMakeTheSameDeckOrAMessage) { expect_cuts_to_be_told(); }

TEST_F(DamagedFiles, WithAFlippedBitLoseNothingInSilence) { expect_flips_to_be_told(500); }

// The files of what carries the tower, in the same scene.
class DamagedSubstructures : public DamagedFiles {
 protected:
  DamagedSubstructures() {
    std::string joined = change(scene, "0     CompHydro", "1     CompHydro");
    joined = change(joined, "0     CompSub", "1     CompSub");
    write("scene.fst", joined +
                           "\"waves.dat\" HydroFile - (quoted string)\n\"jacket.dat\" SubFile - "
                           "(quoted string)\n\"sea.dat\" SeaStFile - (quoted string)\n");
    files_ = {{"ground.dat", write("ground.dat", ground_file)},
              {"jacket.dat", write("jacket.dat", on_ground(subdyn_file))},
              {"sea.dat", write("sea.dat", seastate_file)},
              {"waves.dat", write("waves.dat", hydrodyn_file)}};
    whole_ = import_file(scene_);
  }
};

TEST_F(DamagedSubstructures, ThatAreCutMakeTheSameDeckOrAMessage) { expect_cuts_to_be_told(); }

TEST_F(DamagedSubstructures, WithAFlippedBitLoseNothingInSilence) { expect_flips_to_be_told(500); }

// The files of a platform that floats.
class DamagedFloaters : public DamagedFiles {
 protected:
  DamagedFloaters() {
    std::string joined = change(scene, "0     CompHydro", "1     CompHydro");
    joined = change(joined, "0     CompMooring", "3     CompMooring");
    write("scene.fst", joined +
                           "\"waves.dat\" HydroFile - (quoted string)\n\"lines.dat\" MooringFile - "
                           "(quoted string)\n\"sea.dat\" SeaStFile - (quoted string)\n");
    write("turbine.dat", change(turbine, "--- INITIAL CONDITIONS ---",
                                "True PtfmSgDOF - (flag)\nTrue PtfmHvDOF - (flag)\n5E5 PtfmMass - "
                                "(kg)\n1E7 PtfmRIner - \n1E7 PtfmPIner - \n1E7 PtfmYIner - \n---"
                                " INITIAL CONDITIONS ---"));
    files_ = {{"lines.dat", write("lines.dat", moordyn_file)},
              {"sea.dat", write("sea.dat", seastate_file)},
              {"waves.dat", write("waves.dat", hydrodyn_file)}};
    whole_ = import_file(scene_);
  }
};

TEST_F(DamagedFloaters, ThatAreCutMakeTheSameDeckOrAMessage) {
  EXPECT_NE(whole_.deck.find("Catenary"), std::string::npos);
  expect_cuts_to_be_told();
}

TEST_F(DamagedFloaters, WithAFlippedBitLoseNothingInSilence) { expect_flips_to_be_told(500); }

}  // namespace
}  // namespace culm::openfast
