// Two pictures of one size in one frame, and a line between them that a slider moves.

import { useState } from 'preact/hooks';

import { percent } from './format.ts';

interface Side {
  source: string;
  text: string;
}

export function Wipe({ left, right }: { left: Side; right: Side }) {
  const [share, setShare] = useState(0.5);
  return (
    <figure class="wipe" style={{ '--share': percentage(share) }}>
      <div class="wipe-frame">
        <img src={right.source} alt={right.text} />
        <img class="fill wipe-left" src={left.source} alt={left.text} />
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

function percentage(share: number): string {
  return `${100 * share}%`;
}
