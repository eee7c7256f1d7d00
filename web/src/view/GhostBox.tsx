// Where the thing will stand, for browsers that cannot draw it: its outline, to be moved like the thing itself.
// Or the outline alone, while they cannot.

import { useCallback, useRef } from 'preact/hooks';

import type { DoneEstimate } from '../api/types.ts';
import { holds } from '../light/box.ts';
import { outlineOf } from '../light/placement.ts';
import type { PlacedObject } from '../state/object.ts';
import { placed } from './format.ts';
import { useHandling } from './handling.ts';

export function GhostBox({ estimate, object }: { estimate: DoneEstimate; object: PlacedObject }) {
  const field = useRef<HTMLDivElement>(null);
  const latest = useRef(object);
  latest.current = object;
  const hits = useCallback((x: number, y: number) => {
    const { placement, size, camera } = latest.current;
    return holds(outlineOf(placement, size, camera), x, y);
  }, []);
  const handling = useHandling(field, estimate, object, hits);
  return (
    <div ref={field} class="fill" {...handling}>
      <Ghost object={object} />
    </div>
  );
}

export function Ghost({ object }: { object: PlacedObject }) {
  return (
    <div class="ghost" style={placed(outlineOf(object.placement, object.size, object.camera))}>
      {object.name}
    </div>
  );
}
