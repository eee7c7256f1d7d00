// Numbers for people; none is torn from its unit at the end of a line. And boxes for CSS.

import type { Box } from '../light/box.ts';

const space = '\u00a0';

export function megabytes(bytes: number): string {
  return `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)}${space}MB`;
}

export function fileSize(bytes: number): string {
  if (bytes >= 1e6) return megabytes(bytes);
  return bytes >= 1000 ? `${Math.round(bytes / 1000)}${space}kB` : `${bytes}${space}B`;
}

export function percent(share: number): string {
  return `${Math.round(100 * share)}${space}%`;
}

// For CSS.
export function percentage(share: number): string {
  return `${100 * share}%`;
}

export function placed({ left, top, width, height }: Box) {
  return { left: percentage(left), top: percentage(top), width: percentage(width), height: percentage(height) };
}

// With a real minus sign.
export function degrees(value: number): string {
  const rounded = Math.round(value);
  return `${rounded < 0 ? '−' : ''}${Math.abs(rounded)}°`;
}

export function metres(value: number): string {
  if (value < 1) return `${(100 * value).toFixed(value < 0.1 ? 1 : 0)}${space}cm`;
  return `${value.toFixed(2)}${space}m`;
}

export function seconds(value: number): string {
  return value < 9.95 ? `${value.toFixed(1)}${space}s` : `${Math.round(value)}${space}s`;
}

export function stops(value: number): string {
  const sign = value > 0 ? '+' : value < 0 ? '−' : '';
  return `${sign}${Math.abs(value)}${space}${Math.abs(value) === 1 ? 'stop' : 'stops'}`;
}

export function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

// A file's name without folder and ending.
export function stem(name: string): string {
  return name.replace(/^.*[\\/]/, '').replace(/\.[^.]*$/, '') || 'photo';
}
