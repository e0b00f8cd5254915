#!/usr/bin/env bash
# Fuzzes what users write: scenarios (s), build files (b), module types (m), equations (e), from those that are shipped.
# usage: tests/tools/fuzz.sh [SECONDS]      (600; builds build/fuzz with clang++ first)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"

cd -- "$root"
seconds=${1:-600}
cmake --preset fuzz >/dev/null
cmake --build build/fuzz --target input_fuzz --parallel "$(nproc)"

corpus=build/fuzz/corpus
rm -rf -- "$corpus"
mkdir -p "$corpus" build/fuzz/found
# seed LETTER FILE...: the letter before the content is how the target tells what it is.
seed() {
  local letter=$1 file
  shift
  for file in "$@"; do { printf '%s' "$letter" && cat -- "$file"; } >"$corpus/$letter-$(basename -- "$file")"; done
}
seed s scenarios/*.yaml
seed b scenarios/robots/*.dat
seed m scenarios/modules/*.yaml
for text in 'omega + sum(j in neighbours, w[i,j]*sin(phi[j] - phi[i] - psi[i,j]))' 'if(angle > 0 and not touching, -a, 2^r)' \
  'clamp(tanh(phi), -1, 1)*min(speed, torque)/max(1, abs(t))'; do
  printf 'e%s' "$text" >"$corpus/e-${#text}"
done

build/fuzz/bin/input_fuzz -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 \
  -artifact_prefix=build/fuzz/found/ "$corpus"
