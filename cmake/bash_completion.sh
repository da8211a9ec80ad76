# bash completion of a storey program: bash-completion reads the options off its --help.
complete -F _longopt "${BASH_SOURCE[0]##*/}"
