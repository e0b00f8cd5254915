#include "core/recording/h5_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>

#include "core/recording/h5_library.h"
#include "core/recording/packed_chunks.h"

namespace gaitlab {

namespace {

// New name for a file in memory. HDF5 first searches for a file of this name on the disk, where this path can never exist. The
// name is unique, because HDF5 may have failed to close an earlier file.
std::string nowhere() {
  static std::uint64_t files = 0;  // protected by the lock of Library
  return fmt::format("/dev/null/gaitlab-{}", ++files);
}

constexpr std::size_t kGrowth = std::size_t{1} << 20;  // bytes
constexpr hsize_t kChunkRows = 4096;  // rows of one column, 32 kB; values that follow one another in time compress best
constexpr unsigned kGzip = 1;         // level that the file states; libdeflate compresses the chunks

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  checked(H5Pset_fapl_core(access, kGrowth, 0), "file in memory");
  // The version bounds are fixed, so that a newer library also writes the oldest format, which all readers support.
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), "format bounds");
  return access;
}

// Type of texts of `size` bytes.
Handle string_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "string type");
  checked(H5Tset_size(type, size), "string type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "string type");
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "string type");
  return type;
}

Handle scalar_space() { return {H5Screate(H5S_SCALAR), H5Sclose, "scalar"}; }

// --- writing ----------------------------------------------------------------------------------------------------------

void write_attribute(hid_t owner, const char* name, hid_t stored, hid_t memory, hid_t space, const void* data) {
  Handle attribute(H5Acreate2(owner, name, stored, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  checked(H5Awrite(attribute, memory, data), name);
  attribute.close(name);
}

void write_number(hid_t owner, const char* name, std::int64_t number) {
  write_attribute(owner, name, H5T_STD_I64LE, H5T_NATIVE_INT64, scalar_space(), &number);
}

// Concatenates the texts, each padded with NULs to the length of the longest text.
std::string padded(const std::vector<std::string_view>& texts, std::size_t& size) {
  size = 1;
  for (const std::string_view text : texts) {
    if (text.find('\0') != std::string::npos) throw ImageError("a text with a NUL cannot be stored");
    size = std::max(size, text.size());
  }
  std::string all;
  for (const std::string_view text : texts) {
    all += text;
    all.append(size - text.size(), '\0');
  }
  return all;
}

void write_text(hid_t owner, const char* name, const std::string& text) {
  std::size_t size = 0;
  const std::string bytes = padded({text}, size);
  const Handle type = string_type(size);
  write_attribute(owner, name, type, type, scalar_space(), bytes.data());
}

void write_texts(hid_t owner, const char* name, const Trace& trace, std::string Column::*part) {
  std::vector<std::string_view> texts;
  for (const Column& column : trace.columns) texts.emplace_back(column.*part);
  std::size_t size = 0;
  const std::string bytes = padded(texts, size);
  const hsize_t count = texts.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, name);
  const Handle type = string_type(size);
  write_attribute(owner, name, type, type, space, bytes.data());
}

// Omits dates, and selects a kind of header that can contain attributes above 64 kB.
void plain(hid_t properties) {
  checked(H5Pset_obj_track_times(properties, 0), "properties");
  checked(H5Pset_attr_creation_order(properties, H5P_CRT_ORDER_TRACKED), "properties");
}

hsize_t chunk_rows(hsize_t rows) { return std::min(rows, kChunkRows); }

Handle dataset_properties(const std::array<hsize_t, 2>& shape) {
  Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "dataset properties");
  plain(made);
  if (shape[0] == 0 || shape[1] == 0) return made;
  const std::array<hsize_t, 2> chunk{chunk_rows(shape[0]), 1};
  checked(H5Pset_chunk(made, 2, chunk.data()), "chunks");
  checked(H5Pset_shuffle(made), "shuffle filter");
  checked(H5Pset_deflate(made, kGzip), "gzip filter");
  return made;
}

void write_dataset(hid_t owner, const char* name, const Trace& trace, const Image& image) {
  const std::array<hsize_t, 2> shape{trace.rows(), trace.columns.size()};
  const Handle space(H5Screate_simple(2, shape.data(), nullptr), H5Sclose, "shape");
  const Handle properties = dataset_properties(shape);
  Handle data(H5Dcreate2(owner, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, "dataset");
  if (!trace.values.empty()) {
    // The chunks bypass the filters of HDF5, whose zlib took 27 % of the time of an ordinary run.
    pack_chunks(trace, chunk_rows(shape[0]), [&](std::size_t row, std::size_t column, std::span<const std::byte> bytes) {
      if (column == 0) {
        release(trace.values);
        release(image);
      }
      const std::array<hsize_t, 2> at{row, column};
      checked(H5Dwrite_chunk(data, H5P_DEFAULT, 0, at.data(), bytes.size(), bytes.data()), "writing the values");
    });
  }
  write_texts(data, "columns", trace, &Column::name);
  write_texts(data, "units", trace, &Column::unit);
  write_texts(data, "definitions", trace, &Column::definition);
  data.close("closing the dataset");
}

// --- reading ----------------------------------------------------------------------------------------------------------

std::array<hsize_t, 2> shape_of(hid_t space, int rank, const char* what) {
  std::array<hsize_t, 2> shape{1, 1};
  if (checked(H5Sget_simple_extent_ndims(space), what) != rank) throw ImageError(fmt::format("{} has another shape", what));
  checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr), what);
  return shape;
}

std::int64_t read_number(hid_t owner, const char* name) {
  const Handle attribute(H5Aopen(owner, name, H5P_DEFAULT), H5Aclose, name);
  const Handle type(H5Aget_type(attribute), H5Tclose, name);
  if (checked(H5Tequal(type, H5T_STD_I64LE), name) == 0) throw ImageError(fmt::format("{} is not an integer of 64 bits", name));
  shape_of(Handle(H5Aget_space(attribute), H5Sclose, name), 0, name);
  std::int64_t number = 0;
  checked(H5Aread(attribute, H5T_NATIVE_INT64, &number), name);
  return number;
}

// Reads the texts of an attribute with `rank` dimensions.
std::vector<std::string> read_texts(hid_t owner, const char* name, int rank, std::string_view bytes) {
  const Handle attribute(H5Aopen(owner, name, H5P_DEFAULT), H5Aclose, name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, name);
  if (H5Tget_class(stored) != H5T_STRING) throw ImageError(fmt::format("{} is not a text", name));
  const Handle space(H5Aget_space(attribute), H5Sclose, name);
  const std::size_t count = shape_of(space, rank, name)[0];
  std::vector<std::string> found;
  if (checked(H5Tis_variable_str(stored), name) != 0) throw ImageError(fmt::format("{} is not a text of fixed length", name));
  const std::size_t size = H5Tget_size(stored);
  if (size == 0 || count > bytes.size() / size) throw ImageError(fmt::format("{}: the declared size exceeds the file", name));
  const Handle type = string_type(size);
  if (checked(H5Tequal(stored, type), name) == 0) throw ImageError(fmt::format("{} is not a text in UTF-8", name));
  std::string all(count * size + 1, '\0');  // at least one byte, so that the address is valid without columns
  checked(H5Aread(attribute, type, all.data()), name);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view text = std::string_view(all).substr(i * size, size);
    found.emplace_back(text.substr(0, text.find('\0')));
  }
  return found;
}

std::vector<Column> read_columns(hid_t data, std::size_t count, std::string_view bytes) {
  const std::vector<std::string> names = read_texts(data, "columns", 1, bytes);
  const std::vector<std::string> units = read_texts(data, "units", 1, bytes);
  const std::vector<std::string> definitions = read_texts(data, "definitions", 1, bytes);
  if (names.size() != count || units.size() != count || definitions.size() != count) {
    throw ImageError(
        fmt::format("{} names, {} units, {} definitions of {} columns", names.size(), units.size(), definitions.size(), count));
  }
  std::vector<Column> columns;
  std::unordered_set<std::string> seen;
  for (std::size_t i = 0; i < count; ++i) {
    if (!seen.insert(names[i]).second) throw ImageError(fmt::format("column \"{}\" is there twice", names[i]));
    columns.push_back({names[i], units[i], definitions[i]});
  }
  return columns;
}

/// Refuses soft and external links, which refer to another place or file.
void check_link(hid_t owner, const char* name) {
  H5L_info_t link{};
  checked(H5Lget_info(owner, name, &link, H5P_DEFAULT), name);
  if (link.type != H5L_TYPE_HARD) throw ImageError(fmt::format("{} is a link to another place", name));
}

/// Requires the filters of this program, shuffle then gzip. HDF5 does not run the filters, but their list defines the meaning
/// of the bytes.
void check_filters(hid_t properties) {
  constexpr std::array kFilters{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE};
  const int filters = checked(H5Pget_nfilters(properties), "filters");
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0;
    unsigned config = 0;
    std::size_t values = 0;
    const auto at = static_cast<unsigned>(k);
    const H5Z_filter_t filter = H5Pget_filter2(properties, at, &flags, &values, nullptr, 0, nullptr, &config);
    if (at >= kFilters.size() || filter != kFilters[at])
      throw ImageError(fmt::format("is packed by filter {}; expected shuffle, then gzip", filter));
  }
  if (filters != static_cast<int>(kFilters.size())) throw ImageError("is not packed by shuffle and gzip");
}

/// Requires values that are stored in the file itself, in the chunks of this program. A virtual dataset or external storage
/// would read other files.
void check_storage(hid_t data, hsize_t rows) {
  const Handle properties(H5Dget_create_plist(data), H5Pclose, "properties");
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL || checked(H5Pget_external_count(properties), "external files") != 0)
    throw ImageError("is not stored in this file");
  if (layout != H5D_CHUNKED) throw ImageError("is not stored in chunks");
  check_filters(properties);
  std::array<hsize_t, 2> chunk{};
  H5D_chunk_index_t index{};
  checked(H5Dget_chunk_index_type(data, &index), "index of chunks");
  if (checked(H5Pget_chunk(properties, 2, chunk.data()), "chunks") != 2 || chunk != std::array{chunk_rows(rows), hsize_t{1}} ||
      index != H5D_CHUNK_IDX_BTREE)
    throw ImageError(fmt::format("has other chunks than {} rows of one column", chunk_rows(rows)));
}

/// Reader of the packed chunks of a dataset.
class StoredChunks {
 public:
  StoredChunks(hid_t data, const Image& file) : data_(data), file_(file) {}
  PackedChunk operator()(hsize_t row, hsize_t column) {
    const std::array<hsize_t, 2> at{row, column};
    hsize_t size = 0;
    checked(H5Dget_chunk_storage_size(data_, at.data(), &size), "size of a chunk");
    if (size == 0 || size > file_.size())
      throw ImageError(fmt::format("there is no chunk of column {} from row {} on", column, row));
    bytes_.resize(size);
    std::uint32_t left_out = 0;  // mask of filters, one bit each
    checked(H5Dread_chunk(data_, H5P_DEFAULT, at.data(), &left_out, bytes_.data()), "reading a chunk");
    constexpr std::uint32_t kGzipLeftOut = 2;
    if (left_out != 0 && left_out != kGzipLeftOut)
      throw ImageError(fmt::format("the chunk of column {} from row {} on is not shuffled", column, row));
    return {bytes_, left_out == 0};
  }

 private:
  hid_t data_;
  const Image& file_;
  std::vector<std::byte> bytes_;
};

/// Reads the values without the filters of HDF5, because version 1.10 reads beyond a chunk that is shorter than declared.
void read_rows(hid_t data, hsize_t rows, const Image& file, Trace& trace) {
  trace.values.reserve(rows * trace.columns.size());
  require_workspace();
  StoredChunks stored(data, file);
  const std::size_t length = chunk_rows(rows);
  const auto wrong = unpack_chunks(trace, rows, length, [&](std::size_t row, std::size_t column) {
    if (column == 0) {  // lets the pages of a spilled table and of the file leave memory
      release(trace.values);
      release(file);
    }
    return stored(row, column);
  });
  if (wrong) {
    throw ImageError(fmt::format("the chunk of column {} from row {} on does not unpack to {} bytes", wrong->column, wrong->row,
                                 length * sizeof(double)));
  }
}

Trace read_dataset(hid_t owner, const char* name, const Image& bytes) {
  check_link(owner, name);
  const Handle data(H5Dopen2(owner, name, H5P_DEFAULT), H5Dclose, name);
  const Handle type(H5Dget_type(data), H5Tclose, "type");
  if (checked(H5Tequal(type, H5T_IEEE_F64LE), "type") == 0) throw ImageError("is not float64");
  const auto [rows, columns] = shape_of(Handle(H5Dget_space(data), H5Sclose, "shape"), 2, "the table");
  const bool empty = rows == 0 || columns == 0;
  if (!empty) check_storage(data, rows);
  // gzip compresses at most by a factor of 1032. A larger declared size is forged, and would only exhaust the memory.
  if (!empty && rows > 1040 * bytes.size() / sizeof(double) / columns) throw ImageError("the declared size exceeds the file");
  Trace trace;
  trace.columns = read_columns(data, columns, view(bytes));
  if (!empty) read_rows(data, rows, bytes, trace);
  return trace;
}

/// Reads the dataset at this path. Every error contains the name of the dataset.
Trace read_table(hid_t file, const std::string& name, const Image& bytes) {
  try {
    return read_dataset(file, name.c_str(), bytes);
  } catch (const ImageError& error) {
    throw ImageError(fmt::format("dataset /{}: {}", name, error.what()));
  }
}

}  // namespace

Image to_image(const Trace& trace, const Provenance& origin, std::span<const BesideOf> beside) {
  Image image;
  std::size_t values = trace.values.size();
  for (const BesideOf& one : beside) values += one.table->values.size();
  image.reserve(static_cast<std::size_t>(kFileShare * static_cast<double>(values * sizeof(double))));
  const Library library;
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file creation");
  checked(H5Pset_userblock(creation, kUserBlock), "user block");
  plain(creation);
  const Handle access = file_access();
  H5FD_file_image_callbacks_t memory = memory_of(image);
  checked(H5Pset_file_image_callbacks(access, &memory), "memory of the file");
  Handle file(H5Fcreate(nowhere().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "file");
  write_text(file, "format", std::string(kTraceFormat));
  write_text(file, "scenario", origin.scenario);
  write_text(file, "outcome", origin.outcome);
  write_text(file, "csv_hash", origin.csv_hash);
  write_number(file, "seed", origin.seed);
  write_text(file, "build", origin.build);
  write_number(file, "rows", static_cast<std::int64_t>(trace.rows()));
  write_text(file, "checksum", hash(trace));
  write_dataset(file, "trace", trace, image);
  if (!beside.empty()) {
    const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "group");
    plain(properties);
    const Handle group(H5Gcreate2(file, "recording", H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose, "group");
    for (const BesideOf& one : beside) write_dataset(group, one.name, *one.table, image);
  }
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = checked(H5Fget_file_image(file, nullptr, 0), "size of the file");
  file.close("closing the file");
  image.resize(kUserBlock + static_cast<std::size_t>(size));  // the image grew in pieces of kGrowth
  return image;
}

StoredTrace from_image(const Image& file_bytes) {
  const Library library;
  const Handle access = file_access();
  H5FD_file_image_callbacks_t memory = memory_in_place(file_bytes);
  checked(H5Pset_file_image_callbacks(access, &memory), "memory of the file");
  checked(H5Pset_file_image(access, const_cast<char*>(file_bytes.data()), file_bytes.size()), "image");
  const Handle file(H5Fopen(nowhere().c_str(), H5F_ACC_RDONLY, access), H5Fclose, "opening the file");
  const auto text = [&](const char* name) { return read_texts(file, name, 0, view(file_bytes)).front(); };
  if (text("format") != kTraceFormat)
    throw ImageError("the attribute `format` differs from the format in the first line of the file");
  StoredTrace stored;
  stored.origin = {text("scenario"), read_number(file, "seed"), text("build"), text("outcome"), text("csv_hash")};
  stored.trace = read_table(file, "trace", file_bytes);
  if (read_number(file, "rows") != static_cast<std::int64_t>(stored.trace.rows()))
    throw ImageError(fmt::format("{} rows, of which not all were written", stored.trace.rows()));
  if (text("checksum") != hash(stored.trace)) throw ImageError("the trace does not match its checksum");
  if (checked(H5Lexists(file, "recording", H5P_DEFAULT), "recording") == 0) return stored;
  check_link(file, "recording");
  for (const char* name : kBeside) {
    const std::string path = std::string("recording/") + name;
    if (checked(H5Lexists(file, path.c_str(), H5P_DEFAULT), name) == 0) continue;
    stored.beside.push_back({name, read_table(file, path, file_bytes)});
  }
  return stored;
}

}  // namespace gaitlab
