# SPDX-License-Identifier: Apache-2.0
# What scripts that time commands share; to be sourced. $work is their folder of scratch files.

# Microseconds that a command takes. Where it fails, what it printed is shown.
timed() {
  local begin end
  begin=$(date +%s%N)
  "$@" > "$work/log" 2>&1 || {
    cat "$work/log" >&2
    exit 1
  }
  end=$(date +%s%N)
  echo $(((end - begin) / 1000))
}

# Of the numbers in a file, a line each.
median() { sort -n "$1" | sed -n "$((($(wc -l < "$1") + 1) / 2))p"; }
