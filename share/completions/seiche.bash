# bash completion of seiche: source <(seiche completion bash)
_seiche() {
  local word="${COMP_WORDS[COMP_CWORD]}" words="" named=""
  if [ "$COMP_CWORD" -eq 1 ]; then words="run resume check validate info render plot export init help completion manual schema --help --version"; else
    case "${COMP_WORDS[1]}" in
      run) words="--help --out --overwrite --set --frames --threads --walltime --watchdog --quiet" ;;
      resume) words="--help --end --set --force --frames --threads --walltime --watchdog --quiet" ;;
      check) words="--help --set --picture --measure --threads --json" ;;
      validate) words="--help --level --list --out --cases --write-docs --record --threads --fresh --report-only" ;;
      info) words="--help" ;;
      render) words="--help --frames --size --format --out --color --colors --range --per-frame --streamlines --camera --camera-path --camera-steps --turntable --up --material --foam --transparent --plain --font --contact-sheet --animation" ;;
      plot) words="--help --file --columns --names --out --size --log --font" ;;
      export) words="--help --format --frames --out --up" ;;
      init) words="--help --example --list --overwrite" ;;
      help) named=1; words="run resume check validate info render plot export init help completion manual schema --help" ;;
      completion) named=1; words="bash zsh fish --help" ;;
      manual) words="--help" ;;
      schema) words="--help" ;;
    esac
  fi
  case "$word" in -*) ;; *) [ "$COMP_CWORD" -gt 1 ] && [ -z "$named" ] && return ;; esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _seiche seiche
