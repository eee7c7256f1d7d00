// Files to take home, folded away.

import { fileSize } from '../format.ts';

interface Props {
  summary: string;
  files: { path: string; bytes: number }[];
  addressOf(path: string): string;
  nameOf(path: string): string; // when it is saved
}

export function FileList({ summary, files, addressOf, nameOf }: Props) {
  return (
    <details class="files">
      <summary>{summary}</summary>
      <ul>
        {files.map(({ path, bytes }) => (
          <li key={path}>
            <a href={addressOf(path)} download={nameOf(path)}>
              {path}
            </a>{' '}
            <span class="fine">{fileSize(bytes)}</span>
          </li>
        ))}
      </ul>
    </details>
  );
}
