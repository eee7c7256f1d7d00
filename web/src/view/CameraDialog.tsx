// A photo from this computer's camera.

import { useEffect, useRef, useState } from 'preact/hooks';

import { Alert } from './parts/Alert.tsx';

interface Props {
  onPhoto(photo: Blob): void;
  onClose(): void;
}

export function CameraDialog({ onPhoto, onClose }: Props) {
  const dialog = useRef<HTMLDialogElement>(null);
  const video = useRef<HTMLVideoElement>(null);
  const [ready, setReady] = useState(false);
  const [trouble, setTrouble] = useState<string>();

  useEffect(() => {
    dialog.current?.showModal();
    let stream: MediaStream | undefined;
    let wanted = true;
    openCamera().then(
      (opened) => {
        stream = opened;
        if (wanted && video.current) video.current.srcObject = opened;
        else release(opened);
      },
      (error: unknown) => wanted && setTrouble(sentenceFor(error)),
    );
    return () => {
      wanted = false;
      if (stream) release(stream);
    };
  }, []);

  const shoot = async () => {
    try {
      onPhoto(await pictureOf(video.current!));
    } catch {
      setTrouble('The camera gave no picture. Try again.');
    }
  };

  return (
    <dialog ref={dialog} class="camera" aria-labelledby="camera-title" onClose={onClose}>
      <h2 id="camera-title">Take a photo</h2>
      {!trouble && (
        // Mirrored, as people know themselves; the photo is not.
        <video
          ref={video}
          autoplay
          playsInline
          muted
          onCanPlay={() => setReady(true)}
          aria-label="What the camera sees"
        />
      )}
      <Alert sentence={trouble} />
      <div class="dialog-buttons">
        <button type="button" onClick={() => dialog.current?.close()}>
          Close
        </button>
        {!trouble && (
          <button type="button" class="primary" disabled={!ready} onClick={() => void shoot()}>
            Take the photo
          </button>
        )}
      </div>
    </dialog>
  );
}

async function openCamera(): Promise<MediaStream> {
  // Absent where the page's address is not trusted.
  if (!navigator.mediaDevices) throw new DOMException('', 'NotFoundError');
  return navigator.mediaDevices.getUserMedia({
    video: { width: { ideal: 1920 }, height: { ideal: 1080 } },
    audio: false,
  });
}

function release(stream: MediaStream): void {
  for (const track of stream.getTracks()) track.stop();
}

function sentenceFor(error: unknown): string {
  const name = error instanceof DOMException ? error.name : '';
  if (name === 'NotAllowedError')
    return 'The browser may not use the camera. Allow it for this page, or choose a photo.';
  if (name === 'NotReadableError') return 'Another program has the camera. Close that, or choose a photo.';
  return 'There is no camera here. Choose a photo instead.';
}

function pictureOf(video: HTMLVideoElement): Promise<Blob> {
  const canvas = document.createElement('canvas');
  canvas.width = video.videoWidth;
  canvas.height = video.videoHeight;
  canvas.getContext('2d')!.drawImage(video, 0, 0);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no picture'))), 'image/jpeg', 0.95),
  );
}
