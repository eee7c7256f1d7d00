// What moves the thing in the picture, for whatever shows it there: pointer, wheel and keys.

import type { RefObject } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

import type { DoneEstimate } from '../api/types.ts';
import { farther, moved } from '../light/placement.ts';
import type { PlacedObject } from '../state/object.ts';
import { followPointer } from './gestures.ts';
import { changeOfKey } from './keys.ts';

// `shown` fills the picture's frame and takes the keys. `hits` says where the thing is (view/gestures.ts), undefined while it is
// nowhere. Returns what else `shown` needs.
export function useHandling(
  shown: RefObject<HTMLElement | null>,
  estimate: DoneEstimate,
  object: PlacedObject,
  hits: ((x: number, y: number) => boolean) | undefined,
) {
  const spotM = estimate.spot.distance_m;
  // Listeners outlive a render of the component.
  const now = useRef(object);
  now.current = object;

  useEffect(() => {
    if (!hits) return;
    return followPointer(shown.current!.parentElement!, {
      hits,
      move: (x, y) => {
        const { camera, place } = now.current;
        place((placement) => moved(placement, camera, [x * camera.widthPx, y * camera.heightPx]));
      },
      away: (factor) => now.current.place((placement) => farther(placement, factor, spotM)),
      taken: () => shown.current!.focus({ preventScroll: true }),
    });
  }, [hits]);

  return {
    tabIndex: 0,
    role: 'application',
    'aria-roledescription': 'movable object',
    'aria-label': 'Object in the photo',
    'aria-describedby': 'stage-help',
    onKeyDown: (event: KeyboardEvent) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const change = changeOfKey(event.key, event.shiftKey, object.camera, spotM);
      if (!change) return;
      event.preventDefault();
      object.place(change);
    },
  } as const;
}
