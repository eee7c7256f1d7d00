import { useEffect, useRef } from 'preact/hooks';

// For those who listen or go by keyboard, the page of a photo begins here.
export function PhotoName({ name }: { name: string }) {
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => heading.current?.focus({ preventScroll: true }), []);
  return (
    <h2 class="photo-name" ref={heading} tabIndex={-1}>
      {name || 'Photo'}
    </h2>
  );
}
