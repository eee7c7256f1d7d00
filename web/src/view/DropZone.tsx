// Where photos come in: dropped, chosen, pasted or taken.

import { useRef, useState } from 'preact/hooks';

import type { Intake } from '../state/intake.ts';
import { CameraDialog } from './CameraDialog.tsx';
import { LitBall } from './LitBall.tsx';
import { Alert } from './parts/Alert.tsx';

const photoTypes = 'image/*,.heic,.heif,.exr,.hdr,.tif,.tiff';

export function DropZone({ intake, dragging }: { intake: Intake; dragging: boolean }) {
  const file = useRef<HTMLInputElement>(null);
  const [camera, setCamera] = useState(false);
  return (
    <>
      <section class="drop" data-dragging={dragging} aria-labelledby="drop-title">
        <LitBall />
        <h2 id="drop-title">Drop a photo of a face</h2>
        <p>See the light that fell on it, and put things into the photo in that light.</p>
        <div class="drop-buttons">
          <button type="button" class="primary" disabled={intake.busy} onClick={() => file.current?.click()}>
            Choose a photo
          </button>
          <button type="button" disabled={intake.busy} onClick={() => setCamera(true)}>
            Use the camera
          </button>
          <input
            ref={file}
            type="file"
            accept={photoTypes}
            class="hidden"
            aria-label="Photo file"
            tabIndex={-1}
            onChange={(event) => {
              const chosen = event.currentTarget.files?.[0];
              if (chosen) void intake.takePhoto(chosen, chosen.name);
              event.currentTarget.value = '';
            }}
          />
        </div>
        <p class="fine">JPEG, PNG, HEIC, TIFF, WebP, EXR or HDR. Pasting works too.</p>
        <Alert sentence={intake.trouble} />
      </section>
      {camera && (
        <CameraDialog
          onPhoto={(photo) => {
            setCamera(false);
            void intake.takePhoto(photo, 'Camera photo');
          }}
          onClose={() => setCamera(false)}
        />
      )}
    </>
  );
}
