// Which thing, of what, and where; and its rendering.

import type { DoneEstimate, Info } from '../api/types.ts';
import { reach } from '../light/placement.ts';
import { ownMaterial, type PlacedObject } from '../state/object.ts';
import type { Rendering } from '../state/rendering.ts';
import type { Chosen } from '../state/workbench.ts';
import { capital, degrees, metres } from './format.ts';
import { Alert } from './parts/Alert.tsx';
import { Select } from './parts/Select.tsx';
import { LengthSlider, Slider } from './parts/Slider.tsx';
import { RenderControl } from './RenderControl.tsx';

interface Props {
  estimate: DoneEstimate;
  info: Info | undefined;
  light: Chosen; // that it stands in
  object: PlacedObject;
  rendering: Rendering;
  trouble: string | undefined; // of the preview
}

export function ObjectPanel({ estimate, info, light, object, rendering, trouble }: Props) {
  const { placement, place } = object;
  const { distance_m: distance, height_m: height } = estimate.spot;
  const objects = (info?.objects ?? []).map((name) => ({ value: name, text: capital(name) }));
  const materials = (info?.materials ?? []).map(({ name }) => ({ value: name, text: capital(name) }));
  return (
    <section class="card object" aria-labelledby="object-title">
      <h2 id="object-title">Object in the photo</h2>
      <Alert sentence={trouble ?? object.trouble} />
      <div class="object-controls">
        <Select label="Object" options={objects} value={object.name} onChange={object.chooseObject} />
        <Select
          label="Material"
          options={[{ value: ownMaterial, text: 'Its own' }, ...materials]}
          value={object.material}
          onChange={object.chooseMaterial}
        />
        <LengthSlider
          label="Distance"
          value={placement.distanceM}
          min={distance / reach}
          max={distance * reach}
          text={metres(placement.distanceM)}
          onInput={(distanceM) => place((before) => ({ ...before, distanceM }))}
        />
        <LengthSlider
          label="Height"
          value={placement.heightM}
          min={height / reach}
          max={height * reach}
          text={metres(placement.heightM)}
          onInput={(heightM) => place((before) => ({ ...before, heightM }))}
        />
        <Slider
          label="Turn"
          value={placement.turnDeg}
          min={-180}
          max={180}
          step={1}
          text={degrees(placement.turnDeg)}
          onInput={(turnDeg) => place((before) => ({ ...before, turnDeg }))}
        />
      </div>
      <p class="fine" id="stage-help">
        Drag it, or scroll over it. Keys: arrows move it, + and − bring it nearer and farther, [ and ] turn it.
      </p>
      <RenderControl estimate={estimate} light={light} object={object} rendering={rendering} />
    </section>
  );
}
