// Which estimate the page shows is in its address, so that reload, back and bookmarks work.

import { useEffect, useState } from 'preact/hooks';

function shown(): string | null {
  const id = new URLSearchParams(location.search).get('estimate');
  return id !== null && /^[0-9a-f]{16}$/.test(id) ? id : null;
}

export function useRoute(): [string | null, (id: string | null) => void] {
  const [id, setId] = useState(shown);
  useEffect(() => {
    const follow = () => setId(shown());
    addEventListener('popstate', follow);
    return () => removeEventListener('popstate', follow);
  }, []);
  const go = (next: string | null) => {
    if (next !== shown()) history.pushState(null, '', next === null ? location.pathname : `?estimate=${next}`);
    setId(next);
    scrollTo(0, 0);
  };
  return [id, go];
}
