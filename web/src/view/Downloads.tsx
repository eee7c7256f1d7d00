// Everything that was written, what most people want first.

import { addressOf } from '../api/client.ts';
import type { DoneEstimate } from '../api/types.ts';
import { fileSize, stem } from './format.ts';
import { FileList } from './parts/FileList.tsx';

interface Entry {
  path: string;
  text: string;
}

const wanted: Entry[] = [
  { path: 'environment.exr', text: 'Light map, EXR' },
  { path: 'environment.hdr', text: 'Light map, HDR' },
  { path: 'environment.png', text: 'Light map, PNG' },
  { path: 'blender.py', text: 'Blender script' },
  { path: 'light.usda', text: 'USD scene' },
  { path: 'light.gltf', text: 'glTF scene' },
  { path: 'room.gltf', text: 'Room, glTF' },
  { path: 'report.json', text: 'Report, JSON' },
];

export function Downloads({ estimate }: { estimate: DoneEstimate }) {
  const { id, files } = estimate;
  const name = stem(estimate.name);
  const first = wanted.flatMap(({ path, text }) => {
    const file = files.find((each) => each.path === path);
    return file ? [{ file, text }] : [];
  });
  return (
    <section class="card downloads" aria-labelledby="downloads-title">
      <h2 id="downloads-title">Downloads</h2>
      <ul class="download-list">
        <li>
          <a class="button primary" href={addressOf.archive(id)} download={`${name}.zip`}>
            Everything, ZIP
          </a>
        </li>
        {first.map(({ file, text }) => (
          <li key={file.path}>
            <a class="button" href={addressOf.file(id, file.path)} download={fileName(name, file.path)}>
              {text} <span class="fine">{fileSize(file.bytes)}</span>
            </a>
          </li>
        ))}
      </ul>
      <FileList
        summary="All files"
        files={files}
        addressOf={(path) => addressOf.file(id, path)}
        nameOf={(path) => fileName(name, path)}
      />
    </section>
  );
}

function fileName(name: string, path: string): string {
  return `${name}-${path.replaceAll('/', '-')}`;
}
