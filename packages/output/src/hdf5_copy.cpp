#include "hdf5_copy.hpp"

#include "hdf5_read.hpp"

namespace culm::output {
namespace {

void copy_attributes(const Hdf5File& from, hid_t source, Hdf5File& to, hid_t where) {
  for (const std::string& name : list_attributes(from, source)) {
    switch (find_attribute_kind(from, source, name)) {
      case ContentKind::number:
        to.set_attribute(where, name, read_double(from, source, name));
        break;
      case ContentKind::integer:
        to.set_attribute(where, name, read_int(from, source, name));
        break;
      case ContentKind::text:
        to.set_attribute(where, name, read_text(from, source, name));
        break;
      case ContentKind::texts:
        to.set_attribute(where, name, read_texts(from, source, name));
    }
  }
}

void copy_dataset(const Hdf5File& from, hid_t group, Hdf5File& to, hid_t where,
                  const std::string& name) {
  if (holds_integers(from, group, name)) {
    to.write(where, name, read_ints(from, group, name));
  } else {
    to.write(where, name, read_doubles(from, group, name), read_shape(from, group, name));
  }
  copy_attributes(from, open_dataset(from, group, name).id(), to,
                  open_dataset(to, where, name).id());
}

}  // namespace

void copy_group(const Hdf5File& from, hid_t group, Hdf5File& to, hid_t where,
                const std::string& name) {
  const Handle source = open_group(from, group, name);
  const Handle copy = to.make_group(where, name);
  copy_attributes(from, source.id(), to, copy.id());
  for (const std::string& below : list_links(from, source.id())) {
    if (is_group(from, source.id(), below)) {
      copy_group(from, source.id(), to, copy.id(), below);
    } else {
      copy_dataset(from, source.id(), to, copy.id(), below);
    }
  }
}

}  // namespace culm::output
