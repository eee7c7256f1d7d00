// Where the thing will stand, for browsers that cannot draw it: its outline, to be moved like the thing itself.

import { useCallback, useRef } from 'preact/hooks';

import type { DoneEstimate } from '../api/types.ts';
import { outlineOf, type Outline } from '../light/placement.ts';
import type { PlacedObject } from '../state/object.ts';
import { useHandling } from './handling.ts';

export function GhostBox({ estimate, object }: { estimate: DoneEstimate; object: PlacedObject }) {
  const field = useRef<HTMLDivElement>(null);
  const outline = outlineOf(object.placement, object.size, object.camera);
  const latest = useRef(outline);
  latest.current = outline;
  const hits = useCallback((x: number, y: number) => inside(latest.current, x, y), []);
  const handling = useHandling(field, estimate, object, hits);
  return (
    <div ref={field} class="fill" {...handling}>
      <div
        class="ghost"
        style={{
          left: percentage(outline.left),
          top: percentage(outline.top),
          width: percentage(outline.width),
          height: percentage(outline.height),
        }}
      >
        {object.name}
      </div>
    </div>
  );
}

function inside({ left, top, width, height }: Outline, x: number, y: number): boolean {
  return x >= left && x <= left + width && y >= top && y <= top + height;
}

function percentage(share: number): string {
  return `${100 * share}%`;
}
