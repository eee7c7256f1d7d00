// Two pictures of one size in one frame, and a line between them that a slider moves.

import { useState } from 'preact/hooks';

import { rightOf, whole, type Box } from '../light/box.ts';
import { percent, percentage, placed } from './format.ts';

export interface Side {
  source: string;
  text: string;
  place?: Box; // in shares of the frame, else the whole of it
}

interface Props {
  aspect: number;
  left: Side;
  right: Side;
}

export function Wipe({ aspect, left, right }: Props) {
  const [share, setShare] = useState(0.5);
  const places = { left: left.place ?? whole, right: right.place ?? whole };
  const hidden = rightOf(share, places.left);
  return (
    <figure class="wipe">
      <div class="wipe-frame" style={{ '--aspect': String(aspect), '--share': percentage(share) }}>
        <img style={placed(places.right)} src={right.source} alt={right.text} />
        <img
          class="wipe-left"
          style={{ ...placed(places.left), clipPath: `inset(0 ${percentage(hidden)} 0 0)` }}
          src={left.source}
          alt={left.text}
        />
        {/* Covers the pictures, so that they can be wiped where they are; shown is the line. */}
        <input
          type="range"
          class="fill"
          aria-label="Wipe"
          aria-valuetext={`${percent(share)} left layer`}
          min={0}
          max={1}
          step={0.01}
          value={share}
          onInput={(event) => setShare(event.currentTarget.valueAsNumber)}
        />
        <span class="wipe-line" aria-hidden="true" />
      </div>
      <figcaption class="fine">
        <span>{left.text}</span>
        <span>{right.text}</span>
      </figcaption>
    </figure>
  );
}
