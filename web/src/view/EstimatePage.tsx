// One estimate: at work, failed, or done and to be looked at. Children come last.

import type { ComponentChildren } from 'preact';
import { useEffect } from 'preact/hooks';

import { addressOf, getEstimate } from '../api/client.ts';
import { hasPhoto, isDone, type Info } from '../api/types.ts';
import { useJob } from '../state/job.ts';
import { Alert } from './parts/Alert.tsx';
import { JobProgress } from './parts/JobProgress.tsx';
import { Workbench } from './Workbench.tsx';

interface Props {
  id: string;
  info: Info | undefined;
  preview: string | undefined;
  onName(name: string): void;
  onEnd(): void;
  onNew(): void;
  children: ComponentChildren;
}

export function EstimatePage({ id, info, preview, onName, onEnd, onNew, children }: Props) {
  const {
    thing: estimate,
    job,
    trouble,
  } = useJob(id, {
    get: getEstimate,
    events: addressOf.estimateEvents,
    onEnd,
  });
  const name = estimate?.name ?? '';

  useEffect(() => onName(name), [name]);

  const failed = job?.state === 'failed';
  if (estimate && isDone(estimate)) {
    return (
      <>
        <Alert sentence={trouble} />
        <Workbench estimate={estimate} info={info}>
          {children}
        </Workbench>
      </>
    );
  }
  return (
    <>
      <div class="waiting">
        <WaitingPhoto
          source={preview ?? (hasPhoto(job) ? addressOf.photo(id) : undefined)}
          name={name}
          working={!failed}
        />
        {!failed && !trouble && <JobProgress job={job} label="Estimating the light" />}
        <Alert sentence={trouble ?? job?.error?.message} />
        {(failed || trouble) && (
          <button type="button" class="primary" onClick={onNew}>
            Choose another photo
          </button>
        )}
      </div>
      {children}
    </>
  );
}

function WaitingPhoto({ source, name, working }: { source: string | undefined; name: string; working: boolean }) {
  // Not every browser shows every kind of photo: then there is none until the server has a PNG of it.
  return (
    <div class="waiting-photo" data-working={working}>
      {source !== undefined && (
        <img
          src={source}
          alt={`The photo: ${name}`}
          onError={(event) => {
            event.currentTarget.hidden = true;
          }}
        />
      )}
    </div>
  );
}
