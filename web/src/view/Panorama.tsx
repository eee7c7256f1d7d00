// The map as a panorama, exposed as one likes. Drawn without WebGL.

import { useEffect, useMemo, useRef, useState } from 'preact/hooks';

import { addressOf, getBytes } from '../api/client.ts';
import { sentenceOf } from '../api/failure.ts';
import type { DoneEstimate, MainLight } from '../api/types.ts';
import { developed, fittingStops } from '../light/exposure.ts';
import { uvOfAngles, type RadianceMap } from '../light/radiance_map.ts';
import { within } from '../light/within.ts';
import { useLoaded } from '../state/loaded.ts';
import { pathIn, type Subject } from '../state/workbench.ts';
import { percentage, stops } from './format.ts';
import { Alert } from './parts/Alert.tsx';
import { Check } from './parts/Check.tsx';
import { Slider } from './parts/Slider.tsx';

const width = 512;
const height = 256;
const mostStops = 6;

export function Panorama({ estimate, subject }: { estimate: DoneEstimate; subject: Subject }) {
  const [chosen, choose] = useState<number>();
  const [doubtShown, showDoubt] = useState(false);
  const at = (file: string) => addressOf.file(estimate.id, pathIn(subject.folder, file));
  const map = useLoaded(at('environment.hdr'), async (address) => {
    const [{ readHdr }, bytes] = await Promise.all([import('../maps/read.ts'), getBytes(address)]);
    return readHdr(bytes);
  });
  const confidence = useLoaded(doubtShown ? at('confidence.exr') : null, async (address) => {
    const [{ readExr }, bytes] = await Promise.all([import('../maps/read.ts'), getBytes(address)]);
    return readExr(bytes);
  });
  const fitting = useMemo(() => (map.value ? Math.max(-mostStops, fittingStops(map.value)) : 0), [map.value]);
  const exposure = chosen ?? fitting;
  const error = map.error ?? confidence.error;
  return (
    <div class="panorama">
      <figure>
        <div class="panorama-frame">
          <MapCanvas map={map.value} stops={exposure} />
          {doubtShown && confidence.value && <DoubtCanvas confidence={confidence.value} />}
          {subject.light.main_lights.map((light, index) => (
            <Marker key={index} number={index + 1} light={light} />
          ))}
        </div>
        <figcaption class="fine">
          <span>photo’s right</span>
          <strong>Centre: behind the photographer</strong>
          <span>photo’s left</span>
        </figcaption>
      </figure>
      <Alert sentence={error === undefined ? undefined : sentenceOf(error)} />
      <div class="panorama-bar">
        <Slider
          label="Exposure"
          value={exposure}
          min={-mostStops}
          max={mostStops}
          step={0.5}
          text={stops(exposure)}
          onInput={choose}
        />
        <Check label="Confidence" checked={doubtShown} onChange={showDoubt} />
      </div>
      {doubtShown && <p class="fine">Hatched: what the face did not see; filled in with what is likely.</p>}
    </div>
  );
}

function MapCanvas({ map, stops }: { map: RadianceMap | undefined; stops: number }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    if (!map) return;
    const pixels = new ImageData(developed(map, stops, width, height), width, height);
    canvas.current!.getContext('2d')!.putImageData(pixels, 0, 0);
  }, [map, stops]);
  return (
    <canvas
      ref={canvas}
      class="fill"
      width={width}
      height={height}
      role="img"
      aria-label="Panorama of the light around the face; its centre is behind the photographer"
    />
  );
}

// Dark where nothing is known, and hatched, so that it is not taken for darkness.
function DoubtCanvas({ confidence }: { confidence: RadianceMap }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const pixels = new ImageData(width, height);
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const column = Math.floor((x * confidence.width) / width);
        const row = Math.floor((y * confidence.height) / height);
        const doubt = 1 - confidence.rgb[3 * (row * confidence.width + column)]!;
        const stripe = (x + y) % 12 < 3;
        const at = 4 * (y * width + x);
        pixels.data.fill(stripe ? 255 : 0, at, at + 3);
        pixels.data[at + 3] = 255 * within(doubt, 0, 1) * (stripe ? 0.55 : 0.45);
      }
    }
    canvas.current!.getContext('2d')!.putImageData(pixels, 0, 0);
  }, [confidence]);
  return <canvas ref={canvas} class="fill" width={width} height={height} aria-hidden="true" />;
}

function Marker({ number, light }: { number: number; light: MainLight }) {
  const [u, v] = uvOfAngles(light.azimuth_deg, light.elevation_deg);
  return (
    <span class="marker" style={{ left: percentage(u), top: percentage(v) }} aria-hidden="true">
      {number}
    </span>
  );
}
