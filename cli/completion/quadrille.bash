# SPDX-License-Identifier: MIT
# Completion of the program quadrille for bash.

_quadrille() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local command=${COMP_WORDS[1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "solve explain verify info generate convert view execute-check simulate dispatch export campaign --help --version" -- "$word")
    return
  fi

  local values=
  case $previous in
    --objective) values="sum-of-costs makespan" ;;
    --system) values="dpll dpll-mdd smt-cbs mdd-sat" ;;
    --check) values="watch propagate 1/2 2/3 1/3,2/3 1/2,3/4" ;;
    --cost-search) values="iterative core-guided" ;;
    --backtracking) values="chronological jump" ;;
    --tie) values="any fewest-moves" ;;
    --mdd-growth) values="on-demand full" ;;
    --to)
      values="json cbsh2 lns2 visualizer lacam yaml ccbs"
      if [[ $command == export ]]; then values="csv multidof path vda5050 planviz"; fi
      ;;
    --plan-format | --from) values="json cbsh2 lns2 visualizer lacam yaml ccbs" ;;
    --svg-kind) values="map space-time waits" ;;
    --kind) values="empty random maze room warehouse roadmap" ;;
    --rule) values="naive gated coupled" ;;
    --neighbourhood) values="2 3 4 5" ;;
    --headings) values="4" ;;
    --ros) values="1 2" ;;
    --vda-version) values="2.0 2.1 3.0" ;;
    --map | --scen | --instance | --roadmap | --task | --plan | --json | --proof | --initial-plan | --known-plan | --states | --names | --output | --view | --svg | --map-output | \
      --scen-output | --instance-output | --folder | --data)
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return
      ;;
    --agents | --seed | --*-limit | --passable | --blocked | --width | --height | --obstacles | --doors | \
      --corridor-width | --room-size | --shelf-* | --aisle-width | --side-width | --vertices | --radius | \
      --speed | --level | --vehicle-type | --resolution | --turn | --altitude | --reach | --threads | --gap | --plan-every | --svg-agents | --delays | \
      --longest | --slow | --period | --runs | --rate | --order-id | --time-stamp)
      return
      ;;
  esac
  if [[ -n $values ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
    return
  fi

  local instance="--map --scen --agents --instance --passable --blocked --share-goals --leave --robust --whole-moves
    --roadmap --task --radius --speed --neighbourhood --level --vehicle-type --resolution --overlap-at-start --headings
    --turn"
  local options=
  case $command in
    solve)
      options="$instance --objective --system --check --cost-search --mdd-growth --tie --forbid-first
        --backtracking --no-first-plan --initial-plan --known-bound --threads --race --gap --seed --time-limit --cpu-limit
        --memory-limit --conflict-limit --plan --plan-format --plan-every --check-with --json --history --view --svg
        --svg-kind --svg-agents --proof --quiet --explain --audit --known-plan"
      ;;
    explain)
      options="$instance --objective --seed --time-limit --cpu-limit --memory-limit --conflict-limit --gap
        --json --view"
      ;;
    verify) options="$instance --plan-format --check-with --json --quiet" ;;
    info) options="$instance" ;;
    generate)
      options="--kind --map --map-output --scen-output --agents --any-goal --seed --width --height
        --obstacles --corridor-width --room-size --doors --shelf-columns --shelf-rows --shelf-length
        --shelf-width --aisle-width --side-width --vertices --altitude --radius --speed --reach --mixed --resolution
        --instance-output"
      ;;
    convert) options="$instance --to --from --output" ;;
    view) options="$instance --plan-format --output --svg --svg-kind --svg-agents" ;;
    campaign)
      options="--folder --data --jobs --dry-run --submission --task --quiet"
      if ((COMP_CWORD == 2)) && [[ $word != -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "list run resume reopen submit task status merge" -- "$word")
        return
      fi
      ;;
    export) options="$instance --to --from --rate --ros --vda-version --names --order-id --time-stamp --states --allow-cycles --output" ;;
    execute-check) options="$instance --plan-format --json --quiet" ;;
    dispatch) options="$instance --dispatcher --steps --step --own-tasks --service --delays --longest --effort --window --reach --patience --call-limit --no-improvement --seed --json --view --serve --quiet" ;;
    simulate)
      options="$instance --plan-format --json --quiet --rule --delays --longest --slow --period --runs --seed --view"
      ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options --help" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}

complete -o filenames -F _quadrille quadrille
