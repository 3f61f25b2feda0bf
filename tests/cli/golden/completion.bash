_imgeo() {
  local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}"
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -W "convert info verify export transform sample serve publish completion manual --help --version" -- "$word"))
    return
  fi
  case "${COMP_WORDS[1]} $before" in
    "convert -i"|"convert --input") COMPREPLY=($(compgen -f -- "$word")); return ;;
    "convert -o"|"convert --output") COMPREPLY=($(compgen -d -- "$word")); return ;;
    "convert --up") COMPREPLY=($(compgen -W "auto x y z -x -y -z" -- "$word")); return ;;
    "convert --rotate") COMPREPLY=(); return ;;
    "convert --scale") COMPREPLY=(); return ;;
    "convert --exaggerate") COMPREPLY=(); return ;;
    "convert --rate") COMPREPLY=(); return ;;
    "convert --unit") COMPREPLY=($(compgen -W "auto m cm mm um km in ft yd mi" -- "$word")); return ;;
    "convert --view") COMPREPLY=($(compgen -W "auto front left back right top bottom" -- "$word")); return ;;
    "convert --container") COMPREPLY=($(compgen -W "sig bg" -- "$word")); return ;;
    "convert --profile") COMPREPLY=($(compgen -W "auto compact classic" -- "$word")); return ;;
    "convert --as") COMPREPLY=($(compgen -W "mesh geometry-image height-map sequence video" -- "$word")); return ;;
    "convert --grid") COMPREPLY=(); return ;;
    "convert --target") COMPREPLY=($(compgen -W "web x3dom" -- "$word")); return ;;
    "convert --x3dom-url") COMPREPLY=(); return ;;
    "convert --primitives") COMPREPLY=($(compgen -W "triangles strips points" -- "$word")); return ;;
    "convert --index") COMPREPLY=($(compgen -W "on off" -- "$word")); return ;;
    "convert -vp"|"convert -qp"|"convert --position-bits") COMPREPLY=(); return ;;
    "convert --max-error") COMPREPLY=(); return ;;
    "convert --coord-type") COMPREPLY=($(compgen -W "auto uint8 int8 uint16 int16 float32" -- "$word")); return ;;
    "convert --layout") COMPREPLY=($(compgen -W "separate interleaved" -- "$word")); return ;;
    "convert --normals") COMPREPLY=($(compgen -W "rgb octahedral spherical palette derived" -- "$word")); return ;;
    "convert --images") COMPREPLY=($(compgen -W "png webp" -- "$word")); return ;;
    "convert -vn"|"convert -qn"|"convert --normal-bits") COMPREPLY=(); return ;;
    "convert -vt"|"convert -qt"|"convert --texcoord-bits") COMPREPLY=(); return ;;
    "convert -vc"|"convert --color-bits") COMPREPLY=(); return ;;
    "convert --patch-vertices") COMPREPLY=(); return ;;
    "convert --base") COMPREPLY=(); return ;;
    "convert --instances") COMPREPLY=($(compgen -W "auto never" -- "$word")); return ;;
    "convert --levels") COMPREPLY=($(compgen -W "auto always never" -- "$word")); return ;;
    "convert --group-triangles") COMPREPLY=(); return ;;
    "convert --region-triangles") COMPREPLY=(); return ;;
    "convert --memory") COMPREPLY=(); return ;;
    "convert --work") COMPREPLY=(); return ;;
    "convert --ranks") COMPREPLY=(); return ;;
    "convert --rank") COMPREPLY=(); return ;;
    "convert --silence") COMPREPLY=(); return ;;
    "convert --drop") COMPREPLY=($(compgen -W "none degenerate repeated both" -- "$word")); return ;;
    "convert --keep-attributes") COMPREPLY=(); return ;;
    "convert --attribute-bits") COMPREPLY=(); return ;;
    "convert --textures") COMPREPLY=($(compgen -W "keep webp avif png" -- "$word")); return ;;
    "convert --texture-size") COMPREPLY=(); return ;;
    "convert --texture-quality") COMPREPLY=(); return ;;
    "convert --texture-preview") COMPREPLY=(); return ;;
    "convert --normal-weighting") COMPREPLY=($(compgen -W "area angle uniform" -- "$word")); return ;;
    "convert --crease-angle") COMPREPLY=(); return ;;
    "convert --title") COMPREPLY=(); return ;;
    "convert --effort") COMPREPLY=(); return ;;
    "convert --threads") COMPREPLY=(); return ;;
    "convert -r"|"convert --report") COMPREPLY=($(compgen -f -- "$word")); return ;;
    "verify --memory") COMPREPLY=(); return ;;
    "verify --work") COMPREPLY=(); return ;;
    "export -o"|"export --output") COMPREPLY=($(compgen -f -- "$word")); return ;;
    "export --frame") COMPREPLY=(); return ;;
    "export --level") COMPREPLY=(); return ;;
    "transform -o"|"transform --output") COMPREPLY=($(compgen -f -- "$word")); return ;;
    "transform --operators") COMPREPLY=(); return ;;
    "sample --seats") COMPREPLY=(); return ;;
    "sample --triangles") COMPREPLY=(); return ;;
    "sample --points") COMPREPLY=(); return ;;
    "sample --charts") COMPREPLY=(); return ;;
    "sample --count") COMPREPLY=(); return ;;
    "sample -o"|"sample --output") COMPREPLY=($(compgen -f -- "$word")); return ;;
    "sample --grid") COMPREPLY=(); return ;;
    "sample --rate") COMPREPLY=(); return ;;
    "sample --bits") COMPREPLY=(); return ;;
    "sample --seed") COMPREPLY=(); return ;;
    "sample --frames") COMPREPLY=(); return ;;
    "sample --port") COMPREPLY=(); return ;;
    "sample --host") COMPREPLY=(); return ;;
    "sample --site") COMPREPLY=($(compgen -d -- "$word")); return ;;
    "sample --token") COMPREPLY=(); return ;;
    "sample --view-token") COMPREPLY=(); return ;;
    "serve --port") COMPREPLY=(); return ;;
    "serve --host") COMPREPLY=(); return ;;
    "serve --token") COMPREPLY=(); return ;;
    "serve --view-token") COMPREPLY=(); return ;;
    "serve --max-streams") COMPREPLY=(); return ;;
    "serve --max-frame") COMPREPLY=(); return ;;
    "serve --max-rate") COMPREPLY=(); return ;;
    "publish --vertices") COMPREPLY=(); return ;;
    "publish --box") COMPREPLY=(); return ;;
    "publish --name") COMPREPLY=(); return ;;
    "publish --bits") COMPREPLY=(); return ;;
    "publish --normals") COMPREPLY=(); return ;;
    "publish --colors") COMPREPLY=(); return ;;
    "publish --values") COMPREPLY=(); return ;;
    "publish --attribute") COMPREPLY=(); return ;;
    "publish --rate") COMPREPLY=(); return ;;
    "publish --to") COMPREPLY=(); return ;;
    "publish --token") COMPREPLY=(); return ;;
    "publish --view-token") COMPREPLY=(); return ;;
    "publish --port") COMPREPLY=(); return ;;
    "publish --host") COMPREPLY=(); return ;;
  esac
  case "${COMP_WORDS[1]}" in
    convert) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--input --output --up --rotate --scale --exaggerate --rate --unit --view --container --profile --as --grid --target --x3dom-url --primitives --index --position-bits --max-error --coord-type --layout --normals --images --normal-bits --texcoord-bits --color-bits --patch-vertices --base --instances --levels --group-triangles --region-triangles --memory --work --resume --ranks --rank --silence --drop --keep-attributes --attribute-bits --textures --texture-size --texture-quality --texture-preview --normal-weighting --crease-angle --title --no-pictures --effort --threads --precompress --outside --strict --force --report --json --verbose --help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
    info) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--outside --json --help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
    verify) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--memory --work --outside --json --help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
    export) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--output --frame --level --json --help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
    transform) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--output --operators --outside --json --help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
    sample) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--seats --triangles --points --charts --count --shuffled --output --live --grid --rate --bits --seed --frames --port --host --site --token --view-token --json --help" -- "$word")); else COMPREPLY=($(compgen -W "hall relief boxes cloth water turntable" -- "$word")); fi ;;
    serve) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--port --host --live --token --view-token --max-streams --max-frame --max-rate --help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
    publish) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--vertices --box --name --bits --normals --colors --values --attribute --rate --loop --to --token --view-token --port --host --help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
    completion) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--help" -- "$word")); else COMPREPLY=($(compgen -W "bash zsh fish" -- "$word")); fi ;;
    manual) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "--help" -- "$word")); else COMPREPLY=($(compgen -f -- "$word")); fi ;;
  esac
}
complete -o filenames -F _imgeo imgeo
