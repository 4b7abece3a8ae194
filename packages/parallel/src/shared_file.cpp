#include <culm/base/error.hpp>
#include <culm/parallel/shared_failure.hpp>
#include <culm/parallel/shared_file.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace culm::parallel {
namespace {

// A type of MPI, which goes with its scope.
class Type {
 public:
  explicit Type(MPI_Datatype type) : type_(type) { MPI_Type_commit(&type_); }
  Type(const Type&) = delete;
  Type& operator=(const Type&) = delete;
  ~Type() { MPI_Type_free(&type_); }
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_;
};

// What MPI need not know to do the work.
class Hints {
 public:
  Hints() {
    MPI_Info_create(&info_);
    // the process that writes for others collects so much at a time: Open MPI would take 32 MB
    MPI_Info_set(info_, "cb_buffer_size", "4194304");
  }
  Hints(const Hints&) = delete;
  Hints& operator=(const Hints&) = delete;
  ~Hints() { MPI_Info_free(&info_); }
  MPI_Info get() const { return info_; }

 private:
  MPI_Info info_ = MPI_INFO_NULL;
};

MPI_Datatype make_row(std::size_t width) {
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(width), MPI_DOUBLE, &type);
  return type;
}

MPI_Datatype make_rows(std::span<const RowRange> rows, std::size_t width, MPI_Datatype row) {
  std::vector<int> counts;
  std::vector<MPI_Aint> places;
  for (const RowRange& range : rows) {
    counts.push_back(static_cast<int>(range.count));
    places.push_back(static_cast<MPI_Aint>(range.first * width * sizeof(double)));
  }
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Type_create_hindexed(static_cast<int>(counts.size()), counts.data(), places.data(), row,
                           &type);
  return type;
}

}  // namespace

SharedFile::SharedFile(const Comm& comm, std::filesystem::path path)
    : comm_(comm), path_(std::move(path)) {
  const Hints hints;
  check(MPI_File_open(comm.handle(), path_.c_str(), MPI_MODE_WRONLY, hints.get(), &file_),
        "open file");
}

SharedFile::~SharedFile() {
  if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
}

void SharedFile::write(std::uint64_t place, std::size_t width, std::span<const RowRange> rows,
                       std::span<const double> numbers) {
  const Type row(make_row(width));
  const auto count = static_cast<int>(numbers.size() / width);
  // who writes nothing needs a view all the same, and one that has a length
  const bool is_empty = rows.empty();
  const Type view(is_empty ? make_row(width) : make_rows(rows, width, row.get()));
  check(MPI_File_set_view(file_, static_cast<MPI_Offset>(place), row.get(), view.get(), "native",
                          MPI_INFO_NULL),
        "write file");
  MPI_Status status;
  check(MPI_File_write_at_all(file_, 0, numbers.data(), count, row.get(), &status), "write file");
  int written = 0;
  MPI_Get_count(&status, row.get(), &written);
  check(written == count ? MPI_SUCCESS : MPI_ERR_IO, "write all of file");
}

void SharedFile::sync() { check(MPI_File_sync(file_), "write file"); }

void SharedFile::check(int status, const char* action) const {
  together(comm_, [&] {
    if (status == MPI_SUCCESS) return;
    std::array<char, MPI_MAX_ERROR_STRING> reason{};
    int length = 0;
    MPI_Error_string(status, reason.data(), &length);
    throw FileError(path_.string(),
                    std::string("cannot ") + action + ": " +
                        std::string(reason.data(), static_cast<std::size_t>(length)));
  });
}

}  // namespace culm::parallel
