# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Sourced by the scripts beside this folder. Sets `root`, the source tree.
#
# Environment:
#   QUADRILLE_SKIP_SETUP=1   install nothing; what is missing shows as an error of CMake
#   QUADRILLE_HEARTBEAT=30   seconds between signs of life without a terminal
#   JOBS                     how many processes at a time compile and test; otherwise as many as there
#                            are processors, and memory for
#   QUADRILLE_CMAKE_ARGS     more arguments for the first configuration, split at spaces

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
build_dir=$root/build/release

# All messages go to stderr: stdout belongs to the program that is run in the end.
say() { printf 'quadrille: %s\n' "$*" >&2; }
die() {
  printf 'quadrille: error: %s\n' "$1" >&2
  shift
  if (($#)); then printf '  %s\n' "$@" >&2; fi
  exit 1
}

if [[ -n ${JOBS:-} && ! $JOBS =~ ^[1-9][0-9]{0,3}$ ]]; then die "JOBS is \"$JOBS\", not a number of processes."; fi

# Compilation takes up to 1 GiB per process.
job_count() {
  local cores memory
  if [[ -n ${JOBS:-} ]]; then
    echo "$JOBS"
    return
  fi
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo 2>/dev/null)
  if [[ -n $memory && $memory -lt $cores ]]; then cores=$((memory > 0 ? memory : 1)); fi
  echo "$cores"
}

# why_apt_failed <log of apt>: the reason in a sentence, with apt's own words.
why_apt_failed() {
  local words
  words=$(grep -m 1 '^E: ' "$1" || grep -m 1 -E '^(W:|Err)' "$1" || tail -n 1 "$1")
  words=${words#[EW]: }
  case $(<"$1") in
    *"Release file"*"is expired"*)
      echo "the archive's Release file is expired: it is an old copy (a snapshot, or a mirror that is no longer kept up)," \
        "or this machine's clock is wrong (it says $(date +%F)). apt: $words"
      ;;
    *"Release file"*"is not valid yet"*)
      echo "the archive's Release file is not valid yet: this machine's clock is slow (it says $(date +%F)). apt: $words"
      ;;
    *NO_PUBKEY* | *"GPG error"* | *"is not signed"* | *"ignatures were invalid"* | *"ignatures couldn't be verified"* | *"OpenPGP signature verification failed"*)
      echo "the archive's signature is not one that this system trusts. apt: $words"
      ;;
    *"Temporary failure"* | *"Could not resolve"* | *"Could not connect"* | *"Cannot initiate the connection"* | *"unreachable"* | *"timed out"*)
      echo "the archive cannot be reached: is there a network connection, and a proxy that apt knows? apt: $words"
      ;;
    *"does not have a Release file"* | *"404  Not Found"*) echo "the archive does not have it. apt: $words" ;;
    *"No space left"*) echo "the disk is full. apt: $words" ;;
    *) echo "apt: $words" ;;
  esac
}

# heartbeat <log> <command...>: runs the command with its output in the log, and says every half
# minute that it is still at work and, where ninja or apt tells, how far it is: somebody who watches a
# silent log must be able to tell a long build from one that hangs.
heartbeat() {
  local log=$1 began=$SECONDS step pulse status=0
  shift
  (
    # Nothing ever comes through this pipe; a `sleep` would outlive its parent.
    exec {never}<> <(:)
    while ! read -rt "${QUADRILLE_HEARTBEAT:-30}" -u "$never"; do
      step=$(grep -oE '^(\[[0-9]+/[0-9]+\]|(Get:[0-9]+|Unpacking|Setting up) .*)' "$log" | tail -n 1 | tr -d '[]')
      if [[ $step == [0-9]* ]]; then step="step ${step/\// of }"; fi
      say "still at work after $((SECONDS - began)) s${step:+, $step}"
    done
  ) 9>&- &
  pulse=$!
  "$@" >"$log" 2>&1 || status=$?
  kill "$pulse" 2>/dev/null || true
  wait "$pulse" 2>/dev/null || true
  return "$status"
}

# run_quietly <what> <command...>: shows the output of the command only when it fails.
run_quietly() {
  local what=$1 log
  shift
  log=$(mktemp)
  if ! heartbeat "$log" "$@"; then
    cat "$log" >&2
    rm -f "$log"
    die "$what failed; the output is above."
  fi
  rm -f "$log"
}

# Whether build_dir is configured, for this very tree: one that was moved or copied brings along a
# cache that CMake refuses.
is_configured() {
  [[ -f $build_dir/.configured ]] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build_dir/CMakeCache.txt" 2>/dev/null
}

# configure <cmake arguments...>: configures build_dir unless it was configured with the same.
# Ninja runs CMake again by itself when a CMake file changes.
configure() {
  local stamp=$build_dir/.configured args=("$@") more=()
  read -ra more <<<"${QUADRILLE_CMAKE_ARGS:-}"
  args+=("${more[@]}")
  if [[ -n ${CMAKE_CXX_COMPILER_LAUNCHER:-} ]]; then
    : # the user's
  elif command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  else
    args+=(-DQUADRILLE_PRECOMPILE_HEADERS=ON)
  fi
  if is_configured; then
    if [[ $(<"$stamp") == "${args[*]}" ]]; then return; fi
  else
    rm -rf "$build_dir"
  fi
  say "configuring"
  # Presets are found in the current folder only.
  (cd "$root" && run_quietly "configuring" cmake --preset release "${args[@]}") || exit 1
  printf '%s\n' "${args[*]}" >"$stamp"
}

# build [cmake arguments...]: with ninja's progress on a terminal, quietly otherwise.
build() {
  if [[ -t 2 ]]; then
    cmake --build "$build_dir" -j "$(job_count)" "$@" >&2 || die "the build failed."
  else
    run_quietly "the build" cmake --build "$build_dir" -j "$(job_count)" "$@"
  fi
}

# Two runs at once must not build in the same folder at the same time.
lock_build() {
  mkdir -p "$build_dir" || die "cannot write to $root."
  exec 9>"$root/build/.lock"
  if ! flock -n 9; then
    say "waiting for another build in this tree"
    flock 9
  fi
}
unlock_build() { exec 9>&-; }
