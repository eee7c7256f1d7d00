// The 3D view over the photo: loads stage and maps, and hands on what is chosen.

import { useCallback, useEffect, useRef, useState } from 'preact/hooks';

import { addressOf, getBytes } from '../api/client.ts';
import { sentenceOf } from '../api/failure.ts';
import type { DoneEstimate, Info } from '../api/types.ts';
import type { Stage } from '../stage/stage.ts';
import { materialOf, type PlacedObject } from '../state/object.ts';
import { pathIn, type Subject } from '../state/workbench.ts';
import { Ghost } from './GhostBox.tsx';
import { useHandling } from './handling.ts';

interface Props {
  estimate: DoneEstimate;
  info: Info | undefined;
  subject: Subject;
  object: PlacedObject;
  onTrouble(sentence: string | undefined): void;
}

export function StageCanvas({ estimate, info, subject, object, onTrouble }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [stage, setStage] = useState<Stage>();
  const [lit, setLit] = useState(false);
  const [lost, setLost] = useState(false);

  useEffect(() => {
    let wanted = true;
    let made: Stage | undefined;
    const make = async () => {
      const [{ Stage }, photo] = await Promise.all([import('../stage/stage.ts'), loadedPhoto(estimate.id)]);
      if (!wanted) return;
      made = new Stage(canvas.current!, { camera: object.camera, up: estimate.up_cam, photo }, setLost);
      setStage(made);
    };
    make().catch((error: unknown) => wanted && onTrouble(sentenceOf(error)));
    return () => {
      wanted = false;
      made?.dispose();
      onTrouble(undefined);
    };
  }, [estimate.id]);

  useEffect(() => {
    if (!stage) return;
    let wanted = true;
    const light = async () => {
      const bytes = getBytes(addressOf.file(estimate.id, pathIn(subject.folder, 'environment_rest.exr')));
      const { readExr } = await import('../maps/read.ts');
      const rest = readExr(await bytes);
      if (!wanted) return;
      stage.setLight({ rest, lamp: subject.light.main_lights[0] ?? null });
      setLit(true);
    };
    light().catch((error: unknown) => wanted && onTrouble(sentenceOf(error)));
    return () => {
      wanted = false;
    };
  }, [stage, subject.folder]);

  useEffect(() => {
    if (object.model) stage?.setModel(object.model, materialOf(info, object.material));
  }, [stage, object.model, object.material]);

  useEffect(() => stage?.place(object.placement), [stage, object.placement]);

  useEffect(() => {
    if (!stage) return;
    const frame = canvas.current!.parentElement!;
    const watcher = new ResizeObserver(() => stage.resize(frame.clientWidth, frame.clientHeight));
    watcher.observe(frame);
    return () => watcher.disconnect();
  }, [stage]);

  const hits = useCallback((x: number, y: number) => stage?.hits(x, y) ?? false, [stage]);
  const handling = useHandling(canvas, estimate, object, stage && hits);
  const drawn = lit && !lost;
  return (
    <>
      <canvas
        ref={canvas}
        class="stage fill"
        data-lit={drawn}
        data-ready={drawn && object.model !== undefined}
        {...handling}
      />
      {lost && <Ghost object={object} />}
      <div class="stage-lost" role="status">
        {lost && (
          <p>
            The browser has taken the graphics from the 3D view. The object shows as an outline until it gives them
            back; if that takes long, reload the page.
          </p>
        )}
      </div>
    </>
  );
}

async function loadedPhoto(id: string): Promise<HTMLImageElement> {
  const photo = new Image();
  photo.src = addressOf.photo(id);
  await photo.decode();
  return photo;
}
