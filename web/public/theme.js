// Before the first paint, so that nothing flashes: the theme that was chosen here, if one was. src/state/theme.ts chooses.
try {
  var theme = localStorage.getItem('theme');
  if (theme === 'dark' || theme === 'light') document.documentElement.dataset.theme = theme;
} catch (_) {
  // Without storage the system's theme it is.
}
