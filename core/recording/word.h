// Word that sums up the verdict on a run.
#pragma once
#include "core/names.h"

namespace gaitlab {

/// report/verdict/verdict.h explains the words.
enum class Word { feasible, infeasible, not_judged, failed };

template <>
struct EnumNames<Word> {
  using enum Word;
  static constexpr EnumName<Word> kTable[] = {
      {feasible, "feasible"}, {infeasible, "infeasible"}, {not_judged, "not judged"}, {failed, "failed"}};
};

}  // namespace gaitlab
