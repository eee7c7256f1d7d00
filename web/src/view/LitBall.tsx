// A ball that is lit from where the pointer is: what the page is about, before there is a photo.

import { useEffect, useRef } from 'preact/hooks';

const reachPx = 600; // from where the light comes from straight aside

export function LitBall() {
  const ball = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    const follow = (event: PointerEvent) => {
      const element = ball.current!;
      const box = element.getBoundingClientRect();
      const dx = (event.clientX - box.left - box.width / 2) / reachPx;
      const dy = (event.clientY - box.top - box.height / 2) / reachPx;
      const shrink = 1 / Math.max(1, Math.hypot(dx, dy));
      element.style.setProperty('--x', `${50 + 38 * dx * shrink}%`);
      element.style.setProperty('--y', `${50 + 38 * dy * shrink}%`);
    };
    addEventListener('pointermove', follow);
    return () => removeEventListener('pointermove', follow);
  }, []);
  return <span ref={ball} class="ball" aria-hidden="true" />;
}
