// Small symmetric positive definite systems, solved by L D L^T for a scalar type T, with all loops of constant length.
#pragma once
#include <array>
#include <cstddef>

namespace gaitlab::articulated {

/// Factor of the N x N matrix whose lower triangle is in `m`. solve() replaces b by m^-1 b.
template <class T, std::size_t N>
struct Cholesky {
  std::array<std::array<T, N>, N> m;  ///< after factor(): L below the diagonal, 1 / D on the diagonal

  void factor() {
    for (std::size_t j = 0; j < N; ++j) {
      std::array<T, N> ld;  // L_jk D_k
      for (std::size_t k = 0; k < j; ++k) {
        ld[k] = m[j][k];
        m[j][k] = ld[k] * m[k][k];
        m[j][j] = m[j][j] - ld[k] * m[j][k];
      }
      for (std::size_t i = j + 1; i < N; ++i) {
        for (std::size_t k = 0; k < j; ++k) m[i][j] = m[i][j] - m[i][k] * m[j][k];
      }
      m[j][j] = 1.0 / m[j][j];
    }
  }
  void solve(std::array<T, N>& b) const {
    for (std::size_t i = 1; i < N; ++i) {
      for (std::size_t k = 0; k < i; ++k) b[i] = b[i] - m[i][k] * b[k];
    }
    for (std::size_t i = 0; i < N; ++i) b[i] = b[i] * m[i][i];
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t k = i + 1; k < N; ++k) b[i] = b[i] - m[k][i] * b[k];
    }
  }
};

}  // namespace gaitlab::articulated
