import { useTheme } from '../../state/theme.ts';

export function ThemeSwitch() {
  const [theme, choose] = useTheme();
  const dark = theme === 'dark';
  return (
    <button
      type="button"
      class="switch"
      role="switch"
      aria-checked={dark}
      onClick={() => choose(dark ? 'light' : 'dark')}
    >
      <span>Dark</span>
      <span class="switch-track" aria-hidden="true" />
    </button>
  );
}
