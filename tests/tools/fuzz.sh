#!/usr/bin/env bash
# Fuzzes the readers of input files one after the other (tests/fuzz/readers.h), starting with shipped files and the corpus.
# usage: tests/tools/fuzz.sh [SECONDS [READER...]]      (default 600 s for every reader; first builds build/fuzz with clang++)
# New inputs are in build/fuzz/corpus/READER. With `--keep` as the last word, inputs that reach new code are added to the corpus.
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"

cd -- "$root"
seconds=${1:-600}
words=("${@:2}")
keep=
if ((${#words[@]})) && [[ ${words[-1]} == --keep ]]; then keep=1 && unset 'words[-1]'; fi
((${#words[@]})) || mapfile -t words < <(cd tests/fuzz/corpus && printf '%s\n' *)
cmake --preset fuzz >/dev/null
cmake --build build/fuzz --target input_fuzz --parallel "$(nproc)"

declare -A shipped=([scenario]='scenarios/*.yaml' [build]='scenarios/robots/*.dat' [module]='scenarios/modules/*.yaml'
  [study]='scenarios/studies/*.yaml' [recipe]='scenarios/figures/*.yaml')
mkdir -p build/fuzz/found
for reader in "${words[@]}"; do
  corpus=build/fuzz/corpus/$reader
  mkdir -p "$corpus"
  # shellcheck disable=SC2086 # a pattern
  cp -- tests/fuzz/corpus/"$reader"/* ${shipped[$reader]:-} "$corpus"
  # Leak detection is off, because HDF5 does not free some blocks after an error. Tests with sanitizers detect leaks.
  GAITLAB_READER=$reader build/fuzz/bin/input_fuzz -max_total_time="$seconds" -max_len=16384 -timeout=20 -rss_limit_mb=4096 \
    -detect_leaks=0 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$reader-" "$corpus" 2>&1 | tail -n 12
  [[ -z $keep ]] ||
    GAITLAB_READER=$reader build/fuzz/bin/input_fuzz -merge=1 -max_len=4096 -detect_leaks=0 "tests/fuzz/corpus/$reader" "$corpus"
done
