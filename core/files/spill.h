// Memory for large tables. An array of more than 200 MB lies in an unnamed temporary file, so that the system can free its
// pages.
#pragma once
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace gaitlab {

inline constexpr std::size_t kMostInMemory = 200'000'000;  ///< bytes of one array; a larger one lies in a file

/// Folder of these files: $TMPDIR, or else /var/tmp, because /tmp may be in memory.
std::filesystem::path spill_folder();

/// Maps bytes of a new unnamed file in spill_folder(), reserved on the disk. Maps memory instead if no file can be made there.
/// Throws std::bad_alloc if the disk or the address space is too small.
void* map_spilled(std::size_t bytes);
void unmap_spilled(void* from, std::size_t bytes) noexcept;
/// Lets the pages of these bytes leave memory; the next access reads them again. `from`: as map_spilled returned it.
void release_spilled(const void* from, std::size_t bytes) noexcept;

/// Allocator for vectors that may be larger than the memory. The file disappears with the array, or with the process.
template <class T>
struct Spilled {
  using value_type = T;
  Spilled() = default;
  template <class Other>
  Spilled(const Spilled<Other>&) {}  // NOLINT(google-explicit-constructor): allocators convert

  static constexpr bool in_file(std::size_t count) { return count > kMostInMemory / sizeof(T); }
  T* allocate(std::size_t count) {
    return in_file(count) ? static_cast<T*>(map_spilled(count * sizeof(T))) : std::allocator<T>().allocate(count);
  }
  void deallocate(T* from, std::size_t count) noexcept {
    in_file(count) ? unmap_spilled(from, count * sizeof(T)) : std::allocator<T>().deallocate(from, count);
  }
  friend bool operator==(const Spilled&, const Spilled&) { return true; }
};

template <class T>
using SpilledVector = std::vector<T, Spilled<T>>;

inline std::string_view view(const SpilledVector<char>& bytes) { return {bytes.data(), bytes.size()}; }

/// Lets the pages of an array leave memory if it lies in a file.
template <class T>
void release(const SpilledVector<T>& array) noexcept {
  if (Spilled<T>::in_file(array.capacity())) release_spilled(array.data(), array.capacity() * sizeof(T));
}

/// Calls visit(bytes) for consecutive parts of an array from byte `from` on, and releases each part. The size of every part
/// except the last is a multiple of 8 bytes.
template <class T, class Visit>
void each_part(const SpilledVector<T>& array, const Visit& visit, std::size_t from = 0) {
  constexpr std::size_t kPart = std::size_t{1} << 26;
  std::string_view rest(reinterpret_cast<const char*>(array.data()), array.size() * sizeof(T));
  rest.remove_prefix(std::min(from, rest.size()));
  for (; !rest.empty(); rest.remove_prefix(std::min(kPart, rest.size()))) {
    visit(rest.substr(0, kPart));
    release(array);
  }
}

}  // namespace gaitlab
