#include "core/recording/h5_library.h"

#include <sys/mman.h>

#include <cstring>
#include <new>

namespace gaitlab {

namespace {

H5Guard other_user;

/// Resizes `image`, an Image, and returns its bytes; nullptr if memory is short.
void* grow(std::size_t size, void* image) {
  try {
    Image& bytes = *static_cast<Image*>(image);
    if (size > bytes.capacity()) require_workspace(2 * size);  // first, because HDF5 keeps the old address after a failure
    bytes.resize(size);
    return bytes.data();
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

void require_workspace(std::size_t more) {
  // Memory for HDF5's cache of structures, the texts of a table and the buffers of chunks.
  constexpr std::size_t kWorkspace = std::size_t{1} << 24;  // bytes
  // This mapping takes only address space, because it is not touched. An allocation that is freed immediately could be removed
  // by the compiler.
  void* const mapped = ::mmap(nullptr, kWorkspace + more, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  ::munmap(mapped, kWorkspace + more);
}

void guard_h5(H5Guard guard) noexcept { other_user = guard; }

H5Guard h5_guard() noexcept { return other_user; }

H5FD_file_image_callbacks_t memory_of(Image& image) {
  H5FD_file_image_callbacks_t calls{};
  calls.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* to) { return grow(size, to); };
  calls.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t, void* to) { return grow(size, to); };
  calls.image_memcpy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
  };
  calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  calls.udata_copy = [](void* to) { return to; };
  calls.udata_free = [](void*) -> herr_t { return 0; };
  calls.udata = &image;
  return calls;
}

H5FD_file_image_callbacks_t memory_in_place(const Image& image) {
  H5FD_file_image_callbacks_t calls = memory_of(const_cast<Image&>(image));
  calls.image_malloc = [](std::size_t, H5FD_file_image_op_t, void* from) -> void* { return static_cast<Image*>(from)->data(); };
  calls.image_realloc = [](void*, std::size_t, H5FD_file_image_op_t, void*) -> void* { return nullptr; };
  calls.image_memcpy = [](void* to, const void*, std::size_t, H5FD_file_image_op_t, void*) { return to; };
  return calls;
}

}  // namespace gaitlab
