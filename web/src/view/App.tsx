import { useEffect, useState } from 'preact/hooks';

import { getInfo } from '../api/client.ts';
import { sentenceOf } from '../api/failure.ts';
import { useLoaded } from '../state/loaded.ts';
import { useRoute } from '../state/route.ts';
import { Alert } from './parts/Alert.tsx';
import { ThemeSwitch } from './parts/ThemeSwitch.tsx';
import { PhotoName } from './PhotoName.tsx';
import { Session } from './Session.tsx';

export function App() {
  const info = useLoaded('info', getInfo);
  const [shown, go] = useRoute();
  const [name, setName] = useState('');

  useEffect(() => {
    document.title = shown !== null && name ? `${name} – Faceprobe` : 'Faceprobe';
  }, [shown, name]);

  return (
    <>
      <header class="top">
        <h1>
          <img src="/favicon.svg" alt="" width="28" height="28" /> Faceprobe
        </h1>
        {shown !== null && (
          <>
            <PhotoName key={shown} name={name} />
            <button type="button" onClick={() => go(null)}>
              New photo
            </button>
          </>
        )}
        <ThemeSwitch />
      </header>
      <main>
        {info.error === undefined ? (
          <Session info={info.value} shown={shown} go={go} onName={setName} />
        ) : (
          <Alert sentence={sentenceOf(info.error)} />
        )}
      </main>
      <footer class="bottom">
        <p>Nothing leaves this computer.</p>
        <p>
          <a href="/openapi.json">API</a>
          {info.value && <span> · version {info.value.version}</span>}
        </p>
      </footer>
    </>
  );
}
