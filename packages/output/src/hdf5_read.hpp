/// What the result file tells about itself.
#pragma once

#include <culm/output/recorded.hpp>

#include "hdf5_file.hpp"

#include <string>
#include <vector>

namespace culm::output {

Handle open_group(const Hdf5File& file, hid_t where, const std::string& name);

Handle open_dataset(const Hdf5File& file, hid_t where, const std::string& name);

/// Names of what a group holds, in alphabetical order.
std::vector<std::string> list_links(const Hdf5File& file, hid_t group);

/// Names of the attributes of a group or dataset.
std::vector<std::string> list_attributes(const Hdf5File& file, hid_t where);

/// What an attribute may be: one number, one text, or a list of texts.
enum class ContentKind { number, integer, text, texts };
ContentKind find_attribute_kind(const Hdf5File& file, hid_t where, const std::string& name);

/// Whether a link leads to a group.
bool is_group(const Hdf5File& file, hid_t where, const std::string& name);

/// Whether a dataset holds integers; otherwise it holds doubles. Throws FileError for other types.
bool holds_integers(const Hdf5File& file, hid_t where, const std::string& name);

/// Whether the file itself has an attribute.
bool has_attribute(const Hdf5File& file, const std::string& name);

bool has_link(const Hdf5File& file, hid_t group, const std::string& name);

/// Lengths of a dataset.
Shape read_shape(const Hdf5File& file, hid_t where, const std::string& name);

/// A dataset of one dimension.
std::vector<int> read_ints(const Hdf5File& file, hid_t where, const std::string& name);

/// All numbers of a dataset, slowest index first.
std::vector<double> read_doubles(const Hdf5File& file, hid_t where, const std::string& name);

/// The steps of a result file in the order of their indices.
std::vector<Recorded::Step> read_steps(const Hdf5File& file);

double read_double(const Hdf5File& file, hid_t where, const std::string& attribute);
int read_int(const Hdf5File& file, hid_t where, const std::string& attribute);

std::string read_text(const Hdf5File& file, hid_t where, const std::string& attribute);

/// An attribute that is a list of texts.
std::vector<std::string> read_texts(const Hdf5File& file, hid_t where,
                                    const std::string& attribute);

}  // namespace culm::output
