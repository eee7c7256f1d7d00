// A done estimate: the photo with a thing in it, its light, its layers, its files. Children come last.

import type { ComponentChildren } from 'preact';
import { useEffect, useState } from 'preact/hooks';

import type { DoneEstimate, Info } from '../api/types.ts';
import { hasWebGl } from '../stage/webgl.ts';
import { usePlacedObject } from '../state/object.ts';
import { useRendering } from '../state/rendering.ts';
import { subjectOf, useShown, type Chosen } from '../state/workbench.ts';
import { Downloads } from './Downloads.tsx';
import { LayersPanel } from './LayersPanel.tsx';
import { LightPanel } from './LightPanel.tsx';
import { ObjectPanel } from './ObjectPanel.tsx';
import { Picture, type PictureKind } from './Picture.tsx';
import { RoomPanel } from './RoomPanel.tsx';

const noWebGl =
  'This browser has no WebGL, so the object shows as an outline; it can be moved and rendered all the same.';

interface Props {
  estimate: DoneEstimate;
  info: Info | undefined;
  children: ComponentChildren;
}

export function Workbench({ estimate, info, children }: Props) {
  const [chosen, choose] = useState<Chosen>(estimate.largest_face);
  const [shown, show] = useShown();
  const [kind, setKind] = useState<PictureKind>('preview');
  const [stageTrouble, setStageTrouble] = useState<string>();
  const object = usePlacedObject(estimate, info);
  const rendering = useRendering(estimate.id, () => setKind('rendered'));
  const subject = subjectOf(estimate, chosen);

  // What is changed is to be seen, and the rendered picture does not show it.
  useEffect(() => setKind('preview'), [object.placement, object.name, object.material, chosen]);

  return (
    <div class="bench">
      <div class="bench-picture">
        <Picture
          estimate={estimate}
          info={info}
          subject={subject}
          onChoose={choose}
          object={object}
          rendered={rendering.done}
          kind={rendering.done ? kind : 'preview'}
          onKind={setKind}
          shown={shown}
          onShown={show}
          onStageTrouble={setStageTrouble}
        />
        <ObjectPanel
          estimate={estimate}
          info={info}
          light={subject.chosen}
          object={object}
          rendering={rendering}
          trouble={hasWebGl() ? stageTrouble : noWebGl}
        />
      </div>
      <div class="bench-light">
        <LightPanel estimate={estimate} subject={subject} onChoose={choose} />
        <LayersPanel estimate={estimate} subject={subject} />
      </div>
      {estimate.room && <RoomPanel estimate={estimate} room={estimate.room} />}
      <Downloads estimate={estimate} />
      {children}
    </div>
  );
}
