// From the preview to the path tracer's picture.

import { useState } from 'preact/hooks';

import { addressOf } from '../api/client.ts';
import type { DoneEstimate } from '../api/types.ts';
import { requestFor, type PlacedObject } from '../state/object.ts';
import type { Rendering } from '../state/rendering.ts';
import type { Chosen } from '../state/workbench.ts';
import { stem } from './format.ts';
import { Alert } from './parts/Alert.tsx';
import { Choice } from './parts/Choice.tsx';
import { FileList } from './parts/FileList.tsx';
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
  const { done } = rendering;
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
        <div class="render-buttons">
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
      </div>
      <Alert sentence={rendering.trouble} />
      {done && (
        <FileList
          summary="Rendered files"
          files={done.files ?? []}
          addressOf={(path) => addressOf.insertionFile(done.id, path)}
          nameOf={(path) => `${stem(estimate.name)}-${object.name}-${path}`}
        />
      )}
    </div>
  );
}
