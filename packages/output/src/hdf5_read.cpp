#include "hdf5_read.hpp"

#include <culm/base/error.hpp>

#include <algorithm>

namespace culm::output {

namespace {

herr_t keep_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

herr_t keep_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

Handle open_attribute(const Hdf5File& file, hid_t where, const std::string& name) {
  return {file.check(H5Aopen(where, name.c_str(), H5P_DEFAULT), "find attribute " + name),
          H5Aclose};
}

// How many items there are. A damaged file may claim more than memory holds.
std::size_t find_size(const Hdf5File& file, const Shape& shape, std::size_t item) {
  const std::size_t most = std::filesystem::file_size(file.path()) / item;
  std::size_t size = 1;
  for (const hsize_t length : shape) {
    if (length == 0) return 0;
    if (length > most / size) throw FileError(file.path().string(), "is damaged");
    size *= length;
  }
  return size;
}

template <class T>
T read_number(const Hdf5File& file, hid_t where, const std::string& name, hid_t type) {
  const Handle attribute = open_attribute(file, where, name);
  const Handle space(file.check(H5Aget_space(attribute.id()), "read attribute " + name), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.id()) != 1) {
    throw FileError(file.path().string(), "attribute " + name + " must be one number");
  }
  T value{};
  file.check(H5Aread(attribute.id(), type, &value), "read attribute " + name);
  return value;
}

}  // namespace

Handle open_group(const Hdf5File& file, hid_t where, const std::string& name) {
  return {file.check(H5Gopen2(where, name.c_str(), H5P_DEFAULT), "open group " + name), H5Gclose};
}

Handle open_dataset(const Hdf5File& file, hid_t where, const std::string& name) {
  return {file.check(H5Dopen2(where, name.c_str(), H5P_DEFAULT), "open dataset " + name), H5Dclose};
}

std::vector<std::string> list_links(const Hdf5File& file, hid_t group) {
  std::vector<std::string> names;
  file.check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_name, &names),
             "list a group");
  return names;
}

std::vector<std::string> list_attributes(const Hdf5File& file, hid_t where) {
  std::vector<std::string> names;
  file.check(H5Aiterate2(where, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_attribute, &names),
             "list attributes");
  return names;
}

ContentKind find_attribute_kind(const Hdf5File& file, hid_t where, const std::string& name) {
  const Handle attribute = open_attribute(file, where, name);
  const Handle type(file.check(H5Aget_type(attribute.id()), "read attribute " + name), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind == H5T_FLOAT) return ContentKind::number;
  if (kind == H5T_INTEGER) return ContentKind::integer;
  const Handle space(file.check(H5Aget_space(attribute.id()), "read attribute " + name), H5Sclose);
  return H5Sget_simple_extent_type(space.id()) == H5S_SCALAR ? ContentKind::text
                                                             : ContentKind::texts;
}

bool is_group(const Hdf5File& file, hid_t where, const std::string& name) {
  const Handle object(file.check(H5Oopen(where, name.c_str(), H5P_DEFAULT), "open " + name),
                      H5Oclose);
  return H5Iget_type(object.id()) == H5I_GROUP;
}

bool holds_integers(const Hdf5File& file, hid_t where, const std::string& name) {
  const Handle dataset = open_dataset(file, where, name);
  const Handle type(file.check(H5Dget_type(dataset.id()), "read " + name), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) {
    throw FileError(file.path().string(), "dataset " + name + " must hold numbers");
  }
  return kind == H5T_INTEGER;
}

bool has_attribute(const Hdf5File& file, const std::string& name) {
  return file.check(H5Aexists(file.id(), name.c_str()), "look for attribute " + name) > 0;
}

bool has_link(const Hdf5File& file, hid_t group, const std::string& name) {
  return file.check(H5Lexists(group, name.c_str(), H5P_DEFAULT), "look for " + name) > 0;
}

Shape read_shape(const Hdf5File& file, hid_t where, const std::string& name) {
  const Handle dataset = open_dataset(file, where, name);
  const Handle space(file.check(H5Dget_space(dataset.id()), "read " + name), H5Sclose);
  const int rank = file.check(H5Sget_simple_extent_ndims(space.id()), "read " + name);
  Shape shape(static_cast<std::size_t>(rank));
  file.check(H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr), "read " + name);
  return shape;
}

std::vector<int> read_ints(const Hdf5File& file, hid_t where, const std::string& name) {
  const Shape shape = read_shape(file, where, name);
  if (shape.size() != 1) {
    throw FileError(file.path().string(), "dataset " + name + " must have one dimension");
  }
  std::vector<int> values(find_size(file, shape, sizeof(int)));
  const Handle dataset = open_dataset(file, where, name);
  file.check(H5Dread(dataset.id(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
             "read dataset " + name);
  return values;
}

std::vector<double> read_doubles(const Hdf5File& file, hid_t where, const std::string& name) {
  std::vector<double> values(find_size(file, read_shape(file, where, name), sizeof(double)));
  const Handle dataset = open_dataset(file, where, name);
  file.check(H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
             "read dataset " + name);
  return values;
}

std::vector<Recorded::Step> read_steps(const Hdf5File& file) {
  const Handle steps = open_group(file, file.id(), "steps");
  std::vector<Recorded::Step> found;
  for (const std::string& name : list_links(file, steps.id())) {
    const Handle group = open_group(file, steps.id(), name);
    found.push_back({read_int(file, group.id(), "index"), read_double(file, group.id(), "time"),
                     read_int(file, group.id(), "analysis")});
  }
  // Alphabetical order is not that of the indices once these have more than six digits.
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  return found;
}

double read_double(const Hdf5File& file, hid_t where, const std::string& attribute) {
  return read_number<double>(file, where, attribute, H5T_NATIVE_DOUBLE);
}

int read_int(const Hdf5File& file, hid_t where, const std::string& attribute) {
  return read_number<int>(file, where, attribute, H5T_NATIVE_INT);
}

std::string read_text(const Hdf5File& file, hid_t where, const std::string& name) {
  const std::vector<std::string> texts = read_texts(file, where, name);
  if (texts.size() != 1) throw FileError(file.path().string(), name + " must be one text");
  return texts[0];
}

std::vector<std::string> read_texts(const Hdf5File& file, hid_t where, const std::string& name) {
  const Handle attribute = open_attribute(file, where, name);
  const Handle space(file.check(H5Aget_space(attribute.id()), "read attribute " + name), H5Sclose);
  const Handle type(file.check(H5Aget_type(attribute.id()), "read attribute " + name), H5Tclose);
  if (H5Tis_variable_str(type.id()) <= 0) {
    throw FileError(file.path().string(), "attribute " + name + " must be text");
  }
  const hssize_t count = H5Sget_simple_extent_npoints(space.id());
  if (count < 0 || count > static_cast<hssize_t>(std::filesystem::file_size(file.path()))) {
    throw FileError(file.path().string(), "is damaged");
  }
  std::vector<char*> data(static_cast<std::size_t>(count), nullptr);
  if (data.empty()) return {};
  file.check(H5Aread(attribute.id(), type.id(), data.data()), "read attribute " + name);
  std::vector<std::string> texts;
  for (const char* text : data) texts.emplace_back(text != nullptr ? text : "");
  H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, data.data());
  return texts;
}

}  // namespace culm::output
