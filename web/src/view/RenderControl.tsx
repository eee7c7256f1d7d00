// From the preview to the path tracer's picture.

import { useState } from 'preact/hooks';

import { addressOf } from '../api/client.ts';
import type { DoneEstimate, Insertion } from '../api/types.ts';
import { requestFor, type PlacedObject } from '../state/object.ts';
import type { Rendering } from '../state/rendering.ts';
import type { Chosen } from '../state/workbench.ts';
import { fileSize, stem } from './format.ts';
import { Alert } from './parts/Alert.tsx';
import { Choice } from './parts/Choice.tsx';
import { JobProgress } from './parts/JobProgress.tsx';

interface Props {
  estimate: DoneEstimate;
  light: Chosen;
  object: PlacedObject;
  rendering: Rendering;
}

type Quality = 'preview' | 'final';

const qualities = [
  { value: 'preview', text: 'Quick' },
  { value: 'final', text: 'Final' },
] as const;

export function RenderControl({ estimate, light, object, rendering }: Props) {
  const [quality, setQuality] = useState<Quality>('preview');
  return (
    <div class="render">
      <div class="render-row inline-legends">
        {rendering.job ? (
          <JobProgress job={rendering.job} label="Rendering" />
        ) : (
          <p class="fine">
            What you drag is a preview. Render traces the light for real, with the photo’s blur and grain.
          </p>
        )}
        <Choice<Quality> label="Quality" options={qualities} value={quality} onChange={setQuality} />
        {rendering.job ? (
          <button type="button" onClick={rendering.cancel}>
            Cancel
          </button>
        ) : (
          <>
            <button type="button" onClick={object.reset}>
              Put it back
            </button>
            <button
              type="button"
              class="primary"
              disabled={!object.model}
              onClick={() => void rendering.start(requestFor(object, light, quality))}
            >
              Render
            </button>
          </>
        )}
      </div>
      <Alert sentence={rendering.trouble} />
      {rendering.done && <Rendered insertion={rendering.done} name={`${stem(estimate.name)}-${object.name}`} />}
    </div>
  );
}

function Rendered({ insertion, name }: { insertion: Insertion; name: string }) {
  return (
    <details class="files">
      <summary>Rendered files</summary>
      <ul>
        {(insertion.files ?? []).map(({ path, bytes }) => (
          <li key={path}>
            <a href={addressOf.insertionFile(insertion.id, path)} download={`${name}-${path}`}>
              {path}
            </a>{' '}
            <span class="fine">{fileSize(bytes)}</span>
          </li>
        ))}
      </ul>
    </details>
  );
}
