// Photos that are dropped or pasted anywhere on the page.

import { useEffect, useRef, useState } from 'preact/hooks';

import type { Intake } from './intake.ts';

// True while something is dragged over the page.
export function useIncomingPhotos(intake: Intake): boolean {
  const [dragging, setDragging] = useState(false);
  const latest = useRef(intake);
  latest.current = intake;
  useEffect(() => {
    const take = (file: File | undefined, name: string | undefined) => {
      if (file) void latest.current.takePhoto(file, name ?? file.name);
      return file !== undefined;
    };
    const over = (event: DragEvent) => {
      if (!event.dataTransfer?.types.includes('Files')) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = 'copy';
      setDragging(true);
    };
    const leave = (event: DragEvent) => {
      if (event.relatedTarget === null) setDragging(false);
    };
    const drop = (event: DragEvent) => {
      setDragging(false);
      if (!event.dataTransfer?.types.includes('Files')) return;
      event.preventDefault();
      take(event.dataTransfer.files[0], undefined);
    };
    const paste = (event: ClipboardEvent) => {
      // Browsers call every pasted picture image.png.
      if (take(event.clipboardData?.files[0], 'Pasted photo')) event.preventDefault();
    };
    addEventListener('dragover', over);
    addEventListener('dragleave', leave);
    addEventListener('drop', drop);
    addEventListener('paste', paste);
    return () => {
      removeEventListener('dragover', over);
      removeEventListener('dragleave', leave);
      removeEventListener('drop', drop);
      removeEventListener('paste', paste);
    };
  }, []);
  return dragging;
}
