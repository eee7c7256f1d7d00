// What the face's picture was taken apart into, two layers at a time.

import { useState } from 'preact/hooks';

import { addressOf } from '../api/client.ts';
import type { DoneEstimate } from '../api/types.ts';
import { pathIn, type Subject } from '../state/workbench.ts';
import { capital } from './format.ts';
import { Select } from './parts/Select.tsx';
import { Wipe } from './Wipe.tsx';

const layers = ['diffuse', 'highlight', 'albedo', 'shading', 'normals', 'regions'] as const;

const meanings: Record<string, string> = {
  diffuse: 'the photo without its highlights',
  highlight: 'what the skin mirrors',
  albedo: 'the skin’s own colour',
  shading: 'the light on it',
  normals: 'which way the skin faces',
  regions: 'the parts of the face',
};

export function LayersPanel({ estimate, subject }: { estimate: DoneEstimate; subject: Subject }) {
  const [left, setLeft] = useState<string>('diffuse');
  const [right, setRight] = useState<string>('highlight');
  const options = layers.map((layer) => ({ value: layer, text: capital(layer) }));
  const at = (layer: string) => addressOf.file(estimate.id, pathIn(subject.folder, `${layer}.png`));
  return (
    <section class="card layers" aria-labelledby="layers-title">
      <h2 id="layers-title">Layers</h2>
      {subject.face === null ? (
        <p>Layers belong to one face. Choose one to see them.</p>
      ) : (
        <>
          <div class="pair">
            <Select label="Left layer" options={options} value={left} onChange={setLeft} />
            <Select label="Right layer" options={options} value={right} onChange={setRight} />
          </div>
          <Wipe
            left={{ source: at(left), text: `${capital(left)}: ${meanings[left]}` }}
            right={{ source: at(right), text: `${capital(right)}: ${meanings[right]}` }}
          />
        </>
      )}
    </section>
  );
}
