#!/usr/bin/env bash
# Looks for what is most often wrong in packaging/Containerfile: words that are no instruction, images without a fixed tag, stages and files
# that are not there, package lists left behind, and a last stage that runs as root. It does not build anything.
#   check_containerfile.sh CONTAINERFILE SOURCE_FOLDER
set -euo pipefail

file=$1 source=$2
awk -v source="$source" '
  function fault(text) { printf "%s:%d: %s\n", FILENAME, start, text; faults = 1 }
  function instruction(text,   words, n, name, i, flag) {
    n = split(text, words, /[ \t]+/)
    name = words[1]
    if (name !~ /^(FROM|ARG|ENV|RUN|COPY|WORKDIR|USER|ENTRYPOINT|CMD|LABEL|VOLUME|EXPOSE|STOPSIGNAL|SHELL|HEALTHCHECK)$/) {
      fault(name " is no instruction (of those used here; ADD and ONBUILD are not)")
      return
    }
    if (froms == 0 && name != "FROM" && name != "ARG") fault(name " before FROM")
    if (name == "FROM") {
      froms++
      user = "root"
      entry = 0
      if (!(words[2] in stages)) {
        if (words[2] !~ /:[^\/]+$/) fault("the image " words[2] " has no tag")
        if (words[2] ~ /:latest$/) fault("the tag latest is another image each day")
      }
      if (toupper(words[3]) == "AS") stages[words[4]] = 1
      else if (n > 2) fault("after the image only AS NAME is known")
    }
    if (name == "USER") user = words[2]
    if (name == "ENTRYPOINT" || name == "CMD") {
      if (text !~ /^[A-Z]+ +\[("[^"]*")(, *"[^"]*")*\]$/) fault(name " is no list of strings; a shell would run it and keep signals to itself")
      if (name == "ENTRYPOINT") entry = 1
    }
    if (name == "RUN" && text ~ /apt-get install/) {
      if (text !~ /apt-get update/) fault("apt-get install without update in the same instruction meets old lists")
      if (text !~ /rm -rf \/var\/lib\/apt\/lists/) fault("the package lists stay in the image")
      if (text !~ /install -y/) fault("apt-get install would ask")
    }
    if (name == "WORKDIR" && words[2] !~ /^\//) fault("WORKDIR is not absolute")
    if (name == "COPY") {
      flag = ""
      for (i = 2; i < n; ++i) {
        if (words[i] ~ /^--from=/) { flag = substr(words[i], 8); if (!(flag in stages)) fault("there is no stage " flag) }
        else if (words[i] !~ /^--/ && flag == "" && system("test -e \"" source "/" words[i] "\"") != 0) fault("there is no " words[i])
      }
    }
  }
  /^[ \t]*#/ { next }
  /^[ \t]*$/ && joined == "" { next }
  {
    if (joined == "") start = FNR
    line = $0
    sub(/^[ \t]+/, "", line)
    if (line ~ /\\$/) { sub(/[ \t]*\\$/, "", line); joined = joined line " "; next }
    instruction(joined line)
    joined = ""
  }
  END {
    start = FNR
    if (joined != "") fault("the last line goes on after the end")
    if (froms == 0) fault("no FROM")
    if (froms > 0 && (user == "root" || user == "0")) fault("the last stage runs as root")
    if (froms > 0 && !entry) fault("the last stage has no ENTRYPOINT")
    exit faults
  }' "$file"
