# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Sourced by fetch-cadical: which of the system's package sources are the distribution's own archive.

# What both forms of sources ask: a suite of the distribution itself, not updates, backports or third parties.
# shellcheck disable=SC2016  # awk's own variables
readonly awk_ours='
  function ours(suite) { return suite == codename || suite ~ /^(old)*stable$|^testing$|^unstable$|^sid$|^devel$/ }'

# entries_of_list <file> <codename> <component> <begin of the outputs' names>: one-line sources.
# One output per entry, with @SUITE@ for the suite and that component alone.
entries_of_list() {
  awk -v codename="$2" -v component="$3" -v out="$4" "$awk_ours"'
    $1 == "deb" {
      sub(/#.*/, "")
      at = 2                                     # the URI, after the options in brackets
      if ($2 ~ /^\[/) { while (at < NF && $at !~ /\]$/) ++at; ++at }
      main = 0
      for (i = at + 2; i <= NF; ++i) if ($i == "main" || $i == component) main = 1
      if (!main || !ours($(at + 1))) next
      entry = ""
      for (i = 1; i <= at; ++i) entry = entry $i " "
      if (seen[entry]++) next                    # the same archive in another suite
      print entry "@SUITE@ " component > (out "-" ++count ".list")
    }' "$1"
}

# entries_of_sources <the same>: deb822. A paragraph per entry; fields may go on in lines that begin with a
# blank (an embedded key).
entries_of_sources() {
  awk -v codename="$2" -v component="$3" -v out="$4" "$awk_ours"'
    function has(field_name, word) { return index(" " field[field_name] " ", " " word " ") > 0 }
    function finish(    i, n, words, good) {
      good = 0
      n = split(field["suites"], words, " ")
      for (i = 1; i <= n; ++i) if (ours(words[i])) good = 1
      if (good && has("types", "deb") && (has("components", "main") || has("components", component)) &&
          tolower(field["enabled"]) !~ /no|false|off|0/)
        print "Types: deb\nSuites: @SUITE@\nComponents: " component "\n" kept > (out "-" ++count ".sources")
      kept = ""; name = ""
      delete field
    }
    /^#/ { next }
    /^[ \t]*$/ { finish(); next }
    {
      if ($0 !~ /^[ \t]/) {
        name = tolower($0); sub(/:.*/, "", name)
        value = $0; sub(/^[^:]*:/, "", value)
        field[name] = value
      } else {
        field[name] = field[name] " " $0
      }
      gsub(/[ \t]+/, " ", field[name])
      if (name !~ /^(types|suites|components|enabled)$/) kept = kept $0 "\n"
    }
    END { finish() }' "$1"
}

# collect_entries <folder for them> <codename> <component>: of all sources that apt reads.
collect_entries() {
  local folder=$1 list parts file
  # Where they are is a setting of apt.
  eval "$(apt-config shell list Dir::Etc::SourceList/f parts Dir::Etc::SourceParts/d)"
  mkdir -p "$folder"
  for file in "${list:-/etc/apt/sources.list}" "${parts:-/etc/apt/sources.list.d/}"/*.list; do
    if [[ -f $file ]]; then entries_of_list "$file" "$2" "$3" "$folder/$(basename "$file")"; fi
  done
  for file in "${parts:-/etc/apt/sources.list.d/}"/*.sources; do
    if [[ -f $file ]]; then entries_of_sources "$file" "$2" "$3" "$folder/$(basename "$file")"; fi
  done
}
