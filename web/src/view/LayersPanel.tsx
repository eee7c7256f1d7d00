// What the face's picture was taken apart into, and the picture itself, two at a time.

import { useState } from 'preact/hooks';

import { addressOf } from '../api/client.ts';
import type { DoneEstimate, Face } from '../api/types.ts';
import { pictureAround } from '../light/box.ts';
import { pathIn, type Subject } from '../state/workbench.ts';
import { capital } from './format.ts';
import { Select } from './parts/Select.tsx';
import { Wipe, type Side } from './Wipe.tsx';

const meanings = {
  photo: 'as it was taken',
  diffuse: 'the photo without its highlights',
  highlight: 'what the skin mirrors',
  albedo: 'the skin’s own colour',
  shading: 'the light on it',
  normals: 'which way the skin faces',
  regions: 'the parts of the face',
};

type Layer = keyof typeof meanings;

const options = (Object.keys(meanings) as Layer[]).map((layer) => ({ value: layer, text: capital(layer) }));

export function LayersPanel({ estimate, subject }: { estimate: DoneEstimate; subject: Subject }) {
  const [left, setLeft] = useState<Layer>('photo');
  const [right, setRight] = useState<Layer>('diffuse');
  const { face } = subject;
  return (
    <section class="card layers" aria-labelledby="layers-title">
      <h2 id="layers-title">Layers</h2>
      {face === null ? (
        <p>Layers belong to one face. Choose one to see them.</p>
      ) : (
        <>
          <div class="pair">
            <Select<Layer> label="Left layer" options={options} value={left} onChange={setLeft} />
            <Select<Layer> label="Right layer" options={options} value={right} onChange={setRight} />
          </div>
          <Wipe
            aspect={face.crop_px[2] / face.crop_px[3]}
            left={sideOf(left, estimate, face)}
            right={sideOf(right, estimate, face)}
          />
        </>
      )}
    </section>
  );
}

function sideOf(layer: Layer, { id, photo }: DoneEstimate, face: Face): Side {
  const text = `${capital(layer)}: ${meanings[layer]}`;
  if (layer !== 'photo') return { source: addressOf.file(id, pathIn(face.folder, `${layer}.png`)), text };
  return { source: addressOf.photo(id), text, place: pictureAround(face.crop_px, photo) };
}
