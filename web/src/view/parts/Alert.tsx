// A failure, as a sentence beside what it belongs to.

export function Alert({ sentence }: { sentence: string | undefined }) {
  // The region is there before its text, else some screen readers say nothing.
  return (
    <div class="alert" role="alert">
      {sentence && <p>{sentence}</p>}
    </div>
  );
}
