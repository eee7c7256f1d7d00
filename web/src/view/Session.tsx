// All between header and footer: the way in for photos, or one photo's estimate; and the photos there were.

import type { Info } from '../api/types.ts';
import { useHistory } from '../state/history.ts';
import { useIncomingPhotos } from '../state/incoming.ts';
import { useIntake } from '../state/intake.ts';
import { DropZone } from './DropZone.tsx';
import { EstimatePage } from './EstimatePage.tsx';
import { HistoryStrip } from './HistoryStrip.tsx';
import { Alert } from './parts/Alert.tsx';
import { Samples } from './Samples.tsx';

interface Props {
  info: Info | undefined;
  shown: string | null; // an estimate
  go(id: string | null): void;
  onName(name: string): void;
}

export function Session({ info, shown, go, onName }: Props) {
  const history = useHistory();
  const intake = useIntake(info, (id) => {
    go(id);
    history.refresh();
  });
  const dragging = useIncomingPhotos(intake);
  const strip = (
    <HistoryStrip
      history={history}
      intake={intake}
      shown={shown}
      onPick={go}
      onRemoved={(id) => id === shown && go(null)}
    />
  );
  return (
    <div class="session" data-dragging={dragging}>
      {shown === null ? (
        <>
          <div class="start">
            <DropZone intake={intake} dragging={dragging} />
            <Samples samples={info?.samples ?? []} intake={intake} />
          </div>
          {strip}
        </>
      ) : (
        <>
          <Alert sentence={intake.trouble} />
          <EstimatePage
            key={shown}
            id={shown}
            info={info}
            preview={intake.previewOf(shown)}
            onName={onName}
            onEnd={history.refresh}
            onNew={() => go(null)}
          >
            {strip}
          </EstimatePage>
        </>
      )}
    </div>
  );
}
