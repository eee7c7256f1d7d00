# Synthetic faces, training on them, and measuring.

# Faces that cost little: the built-in head and maps.
few_faces=(--size 32 --views 1 --lights 2 --skins-per-person 1 --seed 4)

case_synth() {
  expect_exit 0 synth --count 3 "${few_faces[@]}" -o faces --preview sheet.png --json
  expect_files faces CARD.md index.json recipe.json shard-00000.safetensors shard-00001.safetensors
  expect_json 3 stdout samples
  expect_json 3 stdout samples_made
  [ -s sheet.png ] || fail "no sheet"
  cp -r faces before
  # Everything is there: nothing is made again, and nothing changes.
  expect_exit 0 synth --count 3 "${few_faces[@]}" -o faces --threads 1 --json
  expect_json 0 stdout samples_made
  diff -r before faces || fail "a second run changed the data set"
  # A shard that is missing is made again, the same.
  rm faces/shard-00001.safetensors
  expect_exit 0 synth --count 3 "${few_faces[@]}" -o faces --json
  expect_json 1 stdout samples_made
  diff -r before faces || fail "a resumed run made something else"
}

case_synth_refusals() {
  expect_refused 2 "size is 8" synth --count 1 --size 8 -o out
  expect_refused 2 "too small for several faces" synth --count 1 --size 64 --multi-face -o out
  expect_refused 2 "people is 5" synth --count 1 --size 192 --multi-face --people 5 -o out
  expect_refused 2 "add multi-face" synth --count 1 --lamps 2 -o out
  expect_refused 2 "such as 1,4" synth --count 1 --size 192 --multi-face --lamp-distance 3 -o out
  expect_refused 2 "4 to 1 m" synth --count 1 --size 192 --multi-face --lamp-distance 4,1 -o out
  expect_refused 2 "--mode" synth --mode magic -o out
  expect_refused 3 "nowhere" synth --heads nowhere -o out
  expect_refused 3 "nowhere" synth --maps nowhere -o out
  expect_refused 3 "nowhere" synth --skins nowhere -o out
  expect_refused 3 "nowhere.mat" synth --reflectance nowhere.mat -o out
  printf 'v 0 0 0\nv 1 0\nf 1 2 9\n' >broken.obj
  expect_refused 3 "broken.obj" synth --heads broken.obj -o out
  mkdir maps
  printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n' >maps/cut.hdr
  expect_refused 3 "cut.hdr" synth --maps maps -o out
  [ ! -e out ] || fail "a refusal left a folder"
  mkdir taken
  expect_exit 0 synth --count 1 "${few_faces[@]}" -o taken
  expect_refused 6 "count is 1 there and 2 here" synth --count 2 "${few_faces[@]}" -o taken
  expect_refused 3 "nowhere" synth unwrap "$photo" --head nowhere -o skins
  expect_refused 2 "--head" synth unwrap "$photo"
}

case_synth_full_disk() {
  (
    trap '' XFSZ
    ulimit -f 8
    expect_refused 6 "cannot be written" synth --count 1 "${few_faces[@]}" -o faces
  )
  [ ! -e faces/shard-00000.safetensors ] || fail "half a shard was left"
  # With room again the same command ends well.
  expect_exit 0 synth --count 1 "${few_faces[@]}" -o faces
  expect_files faces CARD.md index.json recipe.json shard-00000.safetensors
}

case_train_and_eval() {
  expect_exit 0 synth --count 4 --size 64 --views 2 --lights 2 --seed 4 -o faces
  echo '{"batch": 2, "steps": 4, "save_every": 2, "network": {"widths": [8, 16]}}' >tiny.json
  expect_exit 0 train highlight --config tiny.json --data faces --validation faces -o run --threads 1 --json
  expect_json 4 stdout steps
  expect_files run checkpoint.pt config.json curves.png log.csv validation.png weights.safetensors
  expect_exit 0 train highlight --config tiny.json --data faces -o $'not utf8 \xff' --threads 1 --json
  expect_json 4 stdout steps
  expect_exit 0 eval highlight --data faces --weights mine=run/weights.safetensors --samples 4 -o scores --threads 1
  expect_stdout "| mine |"
  expect_stdout "| black layer |"
  expect_files scores highlight.csv highlight.json highlight.png

  echo '{"bach": 2}' >wrong.json
  expect_refused 2 "bach" train highlight --config wrong.json --data faces -o other
  expect_refused 3 "nowhere" train highlight --data nowhere -o other
  expect_refused 7 "cuda" train highlight --data faces -o other --device cuda
  expect_refused 2 "takes no --device" train light --data faces -o other --device cpu
  expect_refused 2 "takes no --scenes" train highlight --data faces -o other --scenes wrong.json
  # Gardner's network is one for rooms: of the open alone it has nothing to learn.
  mkdir maps
  expect_exit 0 estimate "$photo" -o maps/field.hdr "${quick[@]}"
  printf 'name,folder,scene\nfield,outdoor,sunny\n' >scenes.csv
  expect_refused 3 "no map to learn from" train gardner --data maps --scenes scenes.csv -o other
  expect_stderr "0 of the 1 maps in maps are indoor"
  expect_refused 5 "tiny.json" eval highlight --data faces --weights tiny.json
  echo '{"batch": 1, "steps": 4, "network": {"widths": [8, 16]}}' >changed.json
  expect_refused 6 "another config" train highlight --config changed.json --data faces -o run
}

case_face_network() {
  expect_exit 0 synth --count 4 --size 64 --views 2 --lights 2 --seed 4 -o faces
  echo '{"architecture": "face", "batch": 2, "steps": 4, "save_every": 2, "network": {"widths": [8, 16]}}' >face.json
  expect_refused 2 "Name face" train highlight --config face.json --data faces -o run
  expect_refused 3 "faceprobe mesh faces" train face --config face.json --data faces -o run
  expect_exit 0 mesh faces --threads 1 --json
  expect_json faces stdout folder
  expect_json 2 stdout views
  expect_json 2 stdout found
  json stdout seconds >/dev/null || fail "not said how long it took"
  expect_exit 0 train face --config face.json --data faces --validation faces -o run --threads 1
  expect_refused 6 "other data" train face --config face.json --data faces --more faces -o run
  expect_exit 0 train face --config face.json --data faces --more faces -o twice --threads 1
  expect_exit 0 eval geometry --data faces --weights mine=run/weights.safetensors --samples 4 -o scores --threads 1
  expect_stdout "| mine |"
  expect_stdout "| mesh |"
  expect_files scores calibration.html geometry.csv geometry.json geometry.png
  expect_exit 0 eval shading --data faces --weights mine=run/weights.safetensors --samples 4 --threads 1
  expect_stdout "| one albedo |"
  # The paper's network of albedo and shading, which is given the layer that the face network leaves; and its part in an estimate.
  echo '{"architecture": "albedo_shading", "batch": 2, "steps": 2, "network": {"divisor": 16}}' >split.json
  expect_exit 0 train highlight --config split.json --data faces --validation faces -o split --threads 1
  expect_exit 0 eval shading --data faces --weights mine=run/weights.safetensors --weights paper=split/weights.safetensors --samples 4 --threads 1
  expect_stdout "| paper, highlights of mine |"
  expect_exit 0 estimate "$photo" -o paper --solver paper --shading-weights split/weights.safetensors "${quick[@]}"
  expect_json given paper/report.json options shading
  expect_refused 5 "albedo_shading" estimate "$photo" -o other --shading-weights run/weights.safetensors
  expect_refused 2 "leave one of them out" estimate "$photo" -o other --shading regions --shading-weights split/weights.safetensors
  expect_refused 5 "run/config.json" eval geometry --data faces --weights run/config.json
  expect_refused 3 "nowhere" mesh nowhere
}

case_light_prior() {
  expect_exit 0 synth --count 4 --size 64 --views 2 --lights 2 --seed 4 -o faces
  expect_refused 3 "faceprobe mesh faces" trace faces
  expect_exit 0 mesh faces --threads 1
  expect_refused 3 "faceprobe trace faces" train light --data faces -o run
  expect_exit 0 trace faces --threads 1 --json
  expect_json faces stdout folder
  expect_json 4 stdout photos
  expect_json 4 stdout traced
  json stdout seconds >/dev/null || fail "not said how long it took"
  # Nothing is read again.
  expect_exit 0 trace faces --threads 1 --json
  expect_json 0 stdout photos
  echo '{"epoch": 2}' >wrong.json
  expect_refused 2 "epoch" train light --config wrong.json --data faces -o run
  expect_refused 2 "from the start" train light --data faces --start wrong.json -o run
  expect_exit 0 eval relight --data faces --samples 4 --rows 2 -o scores --threads 1
  expect_stdout "| transport |"
  expect_stdout "| ambient |"
  expect_files scores relight.csv relight.json relight.png
  expect_refused 3 "wrong.json" eval relight --data faces --samples 4 --scenes wrong.json
  expect_refused 3 "nowhere.obj" eval relight --data faces --samples 4 --object nowhere.obj
  expect_refused 5 "wrong.json" eval relight --data faces --samples 4 --prior-weights wrong.json
}

case_finetune() {
  expect_exit 0 synth --count 2 "${few_faces[@]}" -o faces
  echo '{"batch": 2, "steps": 2, "network": {"widths": [8, 16]}}' >tiny.json
  expect_exit 0 train highlight --config tiny.json --data faces -o run --threads 1
  local person tune=(finetune --start run/weights.safetensors --data faces --photos 2 --synthetic-batch 1 --threads 1)
  for person in a b c d; do
    mkdir -p "people/$person"
    cp "$data/samples/astronaut.png" "people/$person/1.png"
    cp "$data/samples/astronaut.png" "people/$person/2.png"
  done
  # Who smiles so is left out unless asked for.
  expect_refused 3 "0 people with enough photos" "${tune[@]}" --people people -o tuned
  [ ! -e tuned ] || fail "a refusal left a folder"
  expect_exit 0 "${tune[@]}" --people people --max-expression 0.1 --held-out 0.5 --steps 3 -o tuned
  expect_stdout "| after | 3 |"
  expect_files tuned checkpoint.pt config.json curves.png log.csv people.png scores.csv weights.safetensors
  # What is given beside a config has its say over it.
  echo '{"held_out_share": 0.5, "steps": 5}' >tune.json
  expect_exit 0 "${tune[@]}" --people people --max-expression 0.1 --config tune.json --steps 3 -o again --json
  expect_json 3 stdout steps
  expect_json 3 stdout step_kept
  expect_json 1 stdout people_held_out
  expect_json again/weights.safetensors stdout weights
  json stdout after mean_highlight >/dev/null || fail "no score"
  expect_exit 0 "${tune[@]}" --people people --max-expression 0.1 --config tune.json --validation faces -o checked
  expect_stdout "| change |"
  expect_stdout "RMSE on synthetic skin"
  [ -s checked/validation.png ] || fail "no picture of synthetic faces"
  echo '{"step": 5}' >wrong.json
  expect_refused 2 "energy_weight" "${tune[@]}" --people people --config wrong.json -o wrong
  cmp tuned/weights.safetensors again/weights.safetensors || fail "the same run gave other weights"
}

case_finetune_surface() {
  local person start=$here/../../models/face.safetensors
  expect_exit 0 synth --count 2 --size 64 --views 1 --lights 2 --skins-per-person 1 --seed 4 -o faces
  for person in a b c d; do
    mkdir -p "people/$person"
    cp "$data/samples/astronaut.png" "people/$person/1.png"
    cp "$data/samples/astronaut.png" "people/$person/2.png"
  done
  local tune=(finetune-surface --people people --start "$start" --data faces --photos 2 --synthetic-batch 1 --threads 1
    --max-expression 0.1 --held-out 0.5 --steps 2)
  expect_refused 3 "faceprobe mesh faces" "${tune[@]}" -o tuned
  expect_refused 2 "order is 9" "${tune[@]}" --order 9 -o tuned
  [ ! -e tuned ] || fail "a refusal left a folder"
  expect_exit 0 mesh faces --threads 1
  expect_exit 0 "${tune[@]}" --same-light people --validation faces -o tuned
  expect_stdout "| after |"
  expect_stdout "On synthetic faces:"
  expect_files tuned log.csv weights.safetensors
  expect_exit 0 "${tune[@]}" --same-light people -o again --json
  expect_json 2 stdout steps
  expect_json again/weights.safetensors stdout weights
  json stdout after residual >/dev/null || fail "no score"
  cmp tuned/weights.safetensors again/weights.safetensors || fail "the same run gave other weights"
}
