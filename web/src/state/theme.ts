// Dark or light: the system's choice until someone chooses here, then that, also next time (public/theme.js).

import { useEffect, useState } from 'preact/hooks';

type Theme = 'dark' | 'light';

const prefersDark = matchMedia('(prefers-color-scheme: dark)');

function chosen(): Theme | undefined {
  const theme = document.documentElement.dataset['theme'];
  return theme === 'dark' || theme === 'light' ? theme : undefined;
}

function current(): Theme {
  return chosen() ?? (prefersDark.matches ? 'dark' : 'light');
}

export function useTheme(): [Theme, (theme: Theme) => void] {
  const [theme, setTheme] = useState(current);
  useEffect(() => {
    const follow = () => setTheme(current());
    prefersDark.addEventListener('change', follow);
    return () => prefersDark.removeEventListener('change', follow);
  }, []);
  const choose = (next: Theme) => {
    document.documentElement.dataset['theme'] = next;
    try {
      localStorage.setItem('theme', next);
    } catch {
      // Without storage the choice lasts as long as the page.
    }
    setTheme(next);
  };
  return [theme, choose];
}
