// Photos on their way to the server, from wherever they come.

import { useCallback, useRef, useState } from 'preact/hooks';

import { addressOf, estimatePhoto, estimateSample } from '../api/client.ts';
import { Failure, sentenceOf } from '../api/failure.ts';
import type { Estimate, Info } from '../api/types.ts';
import { megabytes } from '../view/format.ts';

export interface Intake {
  busy: boolean;
  trouble?: string;
  takePhoto(photo: Blob, name: string): Promise<void>;
  takeSample(name: string, title: string): Promise<void>;
  // What the page itself can show of an estimate's photo until the server has it upright and in sRGB.
  previewOf(id: string): string | undefined;
}

export function useIntake(info: Info | undefined, onTaken: (id: string) => void): Intake {
  const [state, setState] = useState<{ busy: boolean; trouble?: string }>({ busy: false });
  const previews = useRef(new Map<string, string>());

  const send = async (post: () => Promise<Estimate>, preview: () => string) => {
    setState({ busy: true });
    try {
      const { id } = await post();
      previews.current.set(id, preview());
      setState({ busy: false });
      onTaken(id);
    } catch (error) {
      setState({ busy: false, trouble: sentenceOf(error) });
    }
  };

  return {
    ...state,
    takePhoto: (photo, name) =>
      send(
        () => {
          const most = info?.max_upload_bytes ?? Infinity;
          if (photo.size > most) throw tooLarge(photo.size, most);
          return estimatePhoto(photo, name);
        },
        () => URL.createObjectURL(photo),
      ),
    takeSample: (name, title) =>
      send(
        () => estimateSample(name, title),
        () => addressOf.sample(name),
      ),
    previewOf: useCallback((id: string) => previews.current.get(id), []),
  };
}

function tooLarge(found: number, most: number): Failure {
  return new Failure(
    'too_large',
    `The file has ${megabytes(found)}; up to ${megabytes(most)} are taken. Save the photo smaller and try again.`,
  );
}
