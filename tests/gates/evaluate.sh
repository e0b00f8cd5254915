#!/usr/bin/env bash
# A program requests points from `gaitlab evaluate`. If evaluate is killed at any moment and started again, it answers from the journal,
# and the rows equal those of an undisturbed process.
# usage: evaluate.sh PROGRAM
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
command -v sqlite3 >/dev/null || { skip "evaluate" "sqlite3 is missing (Debian: sqlite3)"; exit 77; }
source "$root/tests/gates/two_modules.sh"
two_modules "$work" # study without a method and a budget
evaluate() { "$program" evaluate "$work/study.yaml" --quiet "$@"; }
# questions FROM TO: prints one question per line. Every eighth ends a batch, and every fifth repeats the question four lines before.
questions() {
  for ((k = $1; k < $2; ++k)); do
    local n=$((k % 5 == 4 ? k - 4 : k)) words=(phase_oscillator hopf)
    printf '{"id": %d, "parameters": {"cpg.type": "%s", "cpg.frequency": %d.%02d, "cpg.amplitude": 0.%d}}\n' "$k" "${words[n % 2]}" \
      $((1 + n / 100)) $((n % 100)) $((2 + n % 7))
    ((k % 8 != 7)) || echo
  done
}

questions 0 60 >"$work/asked"
cpu_time 0 "$program" evaluate "$work/study.yaml" --quiet --out "$work/timed" -j 1 <"$work/asked"
evaluate --out "$work/whole" -j 2 <"$work/asked" >"$work/answers"
[[ $(wc -l <"$work/answers") == 60 && $(rows "$work/whole" | wc -l) == 96 ]] || bad "60 questions for 48 points of two runs: $(wc -l <"$work/answers") answers, $(rows "$work/whole" | wc -l) rows"
[[ $(sed 's/{"id":\([0-9]*\),.*/\1/' "$work/answers" | tr '\n' ' ') == "$(seq -s ' ' 0 59) " ]] || bad "answers are not in the order of the questions"
questions 0 60 | evaluate --out "$work/whole" -j 1 >"$work/again"
cmp "$work/answers" "$work/again" || bad "asked again, the answers are others"
[[ $(sqlite3 "$work/whole/study.db" 'select sum(runs) from effort') == 96 ]] || bad "what was asked again ran again"
ok "asked again, answered from the journal"

# With answers in order of completion, the answers and rows are the same.
questions 0 60 | evaluate --out "$work/completed" -j 3 --lanes 1 --as-completed >"$work/completed.answers"
cmp <(sort "$work/answers") <(sort "$work/completed.answers") || bad "--as-completed: other answers"
cmp <(rows "$work/whole") <(rows "$work/completed") || bad "--as-completed: other rows"
ok "answers as they are completed"

# After a kill, a complete run of all questions has correct answers and rows. The next kill then begins with an empty folder.
whole_again() {
  questions 0 60 | evaluate --out "$work/killed" -j 2 >"$work/again"
  cmp "$work/answers" "$work/again" || bad "killed: other answers"
  cmp <(rows "$work/whole") <(rows "$work/killed") || bad "killed: other rows"
}
kills 6
while kills_left; do
  try_to_kill 0 "$took" "$program" evaluate "$work/study.yaml" --quiet --out "$work/killed" -j 1 <"$work/asked" ||
    { whole_again && rm -r "$work/killed"; }
done
kills_told "evaluate"
# Then the process that reads the answers ends after nine answers.
{ questions 0 60 | evaluate --out "$work/killed" -j 1 2>/dev/null | head -n 9 >/dev/null; } || true
whole_again
ok "killed, and asked again"

# With other questions in the same folder, existing rows are preserved, and new points get new numbers.
{ questions 50 70; } | evaluate --out "$work/killed" -j 1 >"$work/more"
cmp <(rows "$work/whole") <(rows "$work/killed" | head -n 96) || bad "other questions changed rows"
[[ $(rows "$work/killed" | wc -l) == 112 ]] || bad "other questions: $(rows "$work/killed" | wc -l) rows"
cmp <(tail -n 10 "$work/answers") <(head -n 10 "$work/more") || bad "other questions: other answers"
ok "other questions, in the same folder"

# A search whose points `evaluate` simulates has the same rows as a search that simulates them itself, except for the reasons of
# verdicts. It continues in its folder after the answers have ended.
sed -i '/^replicates/d' "$work/study.yaml"
printf '%s\n' 'objective: {maximize: speed}' 'method: {type: cma, population: 6}' 'budget: {runs: 36}' >>"$work/study.yaml"
"$program" optimize "$work/study.yaml" --quiet --out "$work/alone" -j 2 2>"$work/log" || (($? == 3)) || bad "optimize: $(<"$work/log")"
# searched LINES: a search by the first lines of answers.
searched() {
  rm -f "$work/questions"
  mkfifo "$work/questions"
  { evaluate --out "$work/simulated" -j 1 <"$work/questions" | sed -u "$1q" || true; } 2>"$work/log" |
    "$program" optimize "$work/study.yaml" --ask --quiet --out "$work/searched" >"$work/questions" || bad "optimize --ask: $?"
}
columns() { sqlite3 "$1/study.db" 'select * from run order by run' | sed -E 's/^(([^|]*[|]){5})[^|]*/\1/'; }
searched 9
[[ $(rows "$work/searched" | wc -l) == 9 ]] || bad "after nine answers the search has $(rows "$work/searched" | wc -l) rows"
searched 1000
cmp <(columns "$work/alone") <(columns "$work/searched") || bad "the rows of a search that asks differ from those of a search alone"
[[ $(rows "$work/searched" | wc -l) == 36 ]] || bad "the search that asks has $(rows "$work/searched" | wc -l) rows of 36"
code=0
"$program" evaluate "$work/study.yaml" --quiet --out "$work/taken" --answers "$work/searched" </dev/null 2>"$work/log" || code=$?
((code == 2)) && said "has results that another program gave" || bad "results of another program are taken as answers: exit code $code"
ok "a search whose points another program simulates"

# Endless input causes an error before it fills the memory (`head` limits it for a program that would read everything).
asks=("$program" optimize "$work/many.yaml" --ask --quiet --out "$work/asks")
sed -e 's/^method:.*/method: {type: random}/' -e 's/^budget:.*/budget: {runs: 5000}/' "$work/study.yaml" >"$work/many.yaml"
for command in optimize\ --ask evaluate; do
  # shellcheck disable=SC2086 # words of a command
  endless() { "$program" $command "$work/many.yaml" --quiet --out "$work/endless" >/dev/null 2>"$work/log"; }
  code=0
  head -c 100000000 /dev/zero | endless || code=$?
  ((code == 2)) && said "stdin:1:1: error: the line is longer than 1048576 bytes" || bad "$command: zeros without end: exit code $code"
  code=0
  tr '\0' '\n' </dev/zero | head -c 100000000 | endless || code=$?
  ((code == 2)) && said "stdin:1048577:1: error: the line follows 1048576 bytes of blank lines" || bad "$command: blank lines without end: exit code $code"
  rm -r "$work/endless"
done
ok "input without end"

# A search whose questions have no reader any more ends, although its input stays open; the results that had arrived are taken.
mkfifo "$work/results"
exec 7<>"$work/results"
echo '{"id": 0, "objective": 1}' >&7
code=0
{ "${asks[@]}" <"$work/results" 2>"$work/log" || echo $? >"$work/code"; } | head -n 3 >"$work/first"
[[ ! -e $work/code && $(rows "$work/asks" | wc -l) == 1 ]] || bad "no reader of the questions: $(cat "$work/code" "$work/log"), $(rows "$work/asks" | wc -l) rows"
ok "a search without a reader ends"
# One signal ends a search that waits for room in the pipe of its questions.
mkfifo "$work/full"
exec 6<>"$work/full"
"${asks[@]}" <"$work/results" >"$work/full" 2>"$work/log" 7>&- 6>&- &
search=$!
read -r -t 1200 -u 6 || bad "a search asks nothing"
kill -TERM "$search"
code=0
wait "$search" || code=$?
((code == 1)) && said "interrupted: 1 of 5000 runs" || bad "one signal: exit code $code"
exec 6>&- 7>&-
ok "one signal ends a search"

# If no process reads the answers, the exit code is 1.
mkfifo "$work/answered"
exec 8<>"$work/answered"
exec 9>"$work/answered" 8<&- # closes the reading end before the program starts
code=0
questions 0 60 | evaluate --out "$work/unread" -j 1 2>"$work/log" >&9 9>&- || code=$?
exec 9>&-
((code == 1)) || bad "nobody reads: exit code $code"
said "the reader of the answers has closed"
ok "nobody reads: exit code 1"
verdict
