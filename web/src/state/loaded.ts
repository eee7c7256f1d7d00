// Something that is fetched: on its way, there, or not to be had.

import { useEffect, useState } from 'preact/hooks';

interface Loaded<T> {
  value?: T;
  error?: unknown;
}

// Loads whenever `key` changes; null loads nothing. What comes late, after another key, is dropped.
export function useLoaded<T>(key: string | null, load: (key: string) => Promise<T>): Loaded<T> {
  const [loaded, setLoaded] = useState<Loaded<T> & { key: string | null }>({ key: null });
  useEffect(() => {
    if (key === null) return;
    let wanted = true;
    load(key).then(
      (value) => wanted && setLoaded({ key, value }),
      (error: unknown) => wanted && setLoaded({ key, error }),
    );
    return () => {
      wanted = false;
    };
  }, [key]);
  return loaded.key === key ? loaded : {};
}
