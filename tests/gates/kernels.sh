#!/usr/bin/env bash
# Files compiled for AVX2 and AVX-512 define no symbols that other files may also define. The linker keeps either of two copies,
# and one with wide registers would crash the program on processors without these registers.
# usage: kernels.sh PROGRAM_BUILD_DIR
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
for object in kernel_avx2 kernel_avx512 meter_pass_avx2; do
  file=$(find "$1" -name "$object.cpp.o" -print -quit)
  [[ -n $file ]] || fail "no $object.cpp.o in $1"
  # Shared symbols are weak symbols without the lane type. Data with names of types (V typeinfo, DW.ref) contains no code.
  shared=$(nm --demangle --defined-only "$file" | grep -E ' [Wu] ' | grep -v 'Doubles<' || true)
  [[ -z $shared ]] || bad "$object defines what others may define, too:"$'\n'"$shared"
  [[ $object == kernel_* ]] || continue
  own=$(nm --demangle --defined-only "$file" | grep -c ' [WV] .*Doubles<') || true
  ((own > 5)) || bad "$object: only $own functions of its own lanes found: this test sees nothing"
done
verdict
