# SPDX-License-Identifier: MIT
# Makes the manual pages from one source: quadrille.1 with the version filled in, and
# quadrille-<command>.1 from each of its sections `.SS "quadrille <command>"`, with the synopsis, the options
# that name an instance and the exit status that belong to it.
#
# usage: awk -v version=... -v folder=... -f split.awk quadrille.1 quadrille.1
# The first reading collects what is shared, the second one writes.

FNR == 1 { reading++; section = subsection = command = "" }

reading == 1 {
  gsub(/@VERSION@/, version)
  print > (folder "/quadrille.1")
  if ($1 == ".TH") heading = substr($0, index($0, " 1 "))
}
reading == 1 && $1 == ".SH" { section = $2; subsection = "" }
reading == 1 && $1 == ".SS" { subsection = $0 }
reading == 1 && section == "SYNOPSIS" && $1 == ".B" { synopsis_of = $3 }
reading == 1 && section == "SYNOPSIS" && $1 == ".RI" { synopsis[synopsis_of] = $0 }
reading == 1 && section == "COMMANDS" && subsection ~ /^.SS "quadrille / && $1 == ".SS" {
  name = $3
  sub(/"/, "", name)
  commands[++count] = name
}
reading == 1 && subsection ~ /^.SS "Options that name/ && $1 !~ /^.S[SH]$/ {
  # The first line says which commands have these options.
  if ($0 ~ /^For all commands but/) exempt = $0; else instance = instance $0 "\n"
}
reading == 1 && section == "\"EXIT" && $1 != ".SH" { status = status $0 "\n" }

function finish(  page, i, see) {
  if (command == "") return
  page = folder "/quadrille-" command ".1"
  # Its first sentence, up to a colon, is what the command is for.
  purpose = description
  gsub(/\n/, " ", purpose)
  sub(/[.:] .*|\.$/, "", purpose)
  printf ".\\\" SPDX-License-Identifier: MIT\n.TH QUADRILLE-%s%s\n", toupper(command), heading > page
  printf ".SH NAME\nquadrille-%s \\- %s\n", command, tolower(substr(purpose, 1, 1)) substr(purpose, 2) > page
  printf ".SH SYNOPSIS\n.B quadrille %s\n%s\n", command, synopsis[command] > page
  printf ".SH DESCRIPTION\n%s.SH OPTIONS\n%s", description, options > page
  if (exempt !~ ("[ ]" command "[ .]")) printf ".SH \"OPTIONS THAT NAME AN INSTANCE\"\n%s", instance > page
  printf ".SH \"EXIT STATUS\"\n%s.SH \"SEE ALSO\"\n.BR quadrille (1)", status > page
  for (i = 1; i <= count; ++i)
    if (commands[i] != command) printf ",\n.BR quadrille-%s (1)", commands[i] > page
  printf "\n" > page
  close(page)
  command = description = options = ""
}

reading == 2 && ($1 == ".SS" || $1 == ".SH") {
  finish()
  if ($0 ~ /^.SS "quadrille /) {
    command = $3
    sub(/"/, "", command)
  }
  next
}
reading == 2 && command != "" {
  if (options != "" || $1 == ".TP") options = options $0 "\n"; else description = description $0 "\n"
}
END { finish() }
