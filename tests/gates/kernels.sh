#!/usr/bin/env bash
# The files that are compiled for AVX2 and AVX-512 define nothing that another file may define, too: of two copies the linker
# keeps either, and one with wide registers would end the program on a processor without them.
# usage: kernels.sh PROGRAM_BUILD_DIR
set -euo pipefail
folder=$1
bad=0
for object in pack_avx2 pack_avx512; do
  file=$(find "$folder" -name "$object.cpp.o" -print -quit)
  [[ -n $file ]] || { echo "no $object.cpp.o in $folder"; exit 1; }
  own=$(nm --demangle --defined-only "$file" | grep -c ' [WV] .*Doubles<') || true
  ((own > 5)) || { echo "$object: only $own functions of its own lanes found: this test sees nothing"; bad=1; }
  # Shared: weak, not of the lane type. Data that names types (V typeinfo, DW.ref) has no code.
  shared=$(nm --demangle --defined-only "$file" | grep -E ' [Wu] ' | grep -v 'Doubles<' || true)
  [[ -z $shared ]] || { printf '%s defines what others may define, too:\n%s\n' "$object" "$shared"; bad=1; }
done
exit "$bad"
