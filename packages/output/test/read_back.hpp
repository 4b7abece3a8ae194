/// Reading files back, independently of the code that wrote them.
#pragma once

#include <hdf5.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace culm::output {

inline std::string read_text_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All numbers of a dataset; empty if it cannot be read.
inline std::vector<double> read_dataset(const std::filesystem::path& path,
                                        const std::string& name) {
  std::vector<double> values;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return values;
  hid_t dataset = -1;
  H5E_BEGIN_TRY { dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT); }
  H5E_END_TRY;
  if (dataset >= 0) {
    const hid_t space = H5Dget_space(dataset);
    values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(dataset);
  }
  H5Fclose(file);
  return values;
}

/// Number of links in a group; negative if it cannot be read.
inline long count_links(const std::filesystem::path& path, const std::string& name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return -1;
  H5G_info_t info{};
  const herr_t status = H5Gget_info_by_name(file, name.c_str(), &info, H5P_DEFAULT);
  H5Fclose(file);
  return status < 0 ? -1 : static_cast<long>(info.nlinks);
}

/// What a Python script prints, with `argument` as its sys.argv[1]; errors are in the text.
inline std::string run_python(const std::string& script, const std::filesystem::path& argument) {
  const std::string file = argument.string() + ".check.py";
  std::ofstream(file) << script;
  const std::string command = "/usr/bin/python3 '" + file + "' '" + argument.string() + "' 2>&1";
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return "no python";
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
  ::pclose(pipe);
  return text;
}

inline bool has_python(const std::string& module) {
  return std::system(("/usr/bin/python3 -c 'import " + module + "' > /dev/null 2>&1").c_str()) == 0;
}

}  // namespace culm::output
