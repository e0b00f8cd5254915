// Numbers and texts in a string of bytes, each with its length.
#pragma once
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::kit {

/// Thrown by Bytes for other lengths than the expected ones.
struct BadBytes : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void put(std::string& to, const std::vector<double>& numbers) {
  const std::uint64_t count = numbers.size();
  to.append(reinterpret_cast<const char*>(&count), sizeof count);
  to.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
}

inline void put(std::string& to, const std::string& text) {
  const std::uint64_t count = text.size();
  to.append(reinterpret_cast<const char*>(&count), sizeof count);
  to += text;
}

/// Reader of such bytes. Its functions throw BadBytes.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}
  std::vector<double> numbers(std::size_t expected) {
    if (take_count(sizeof(double)) != expected) throw BadBytes("do not fit");
    std::vector<double> all(expected);
    take(all.data(), expected * sizeof(double));
    return all;
  }
  /// Numbers in whole rows of `row`.
  std::vector<double> rows(std::size_t row) {
    std::vector<double> all(take_count(sizeof(double)));
    if (row == 0 || all.size() % row != 0) throw BadBytes("do not fit");
    take(all.data(), all.size() * sizeof(double));
    return all;
  }
  std::string text() {
    std::string all(take_count(1), '\0');
    take(all.data(), all.size());
    return all;
  }

 private:
  std::size_t take_count(std::size_t size) {
    std::uint64_t count = 0;
    if (rest_.size() < sizeof count) throw BadBytes("end too early");
    take(&count, sizeof count);
    if (count > rest_.size() / size) throw BadBytes("end too early");
    return count;
  }
  void take(void* to, std::size_t bytes) {
    if (bytes > 0) std::memcpy(to, rest_.data(), bytes);  // an empty vector has no address
    rest_.remove_prefix(bytes);
  }
  std::string_view rest_;
};

}  // namespace gaitlab::kit
