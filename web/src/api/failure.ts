import type { FailureBody, FailureKind } from './types.ts';

// What went wrong, as a sentence for people. `gone`: nobody answers at the server's address.
export class Failure extends Error {
  readonly kind: FailureKind | 'gone' | 'page';

  constructor(kind: FailureKind | 'gone' | 'page', message: string) {
    super(message);
    this.kind = kind;
  }

  static of(body: FailureBody): Failure {
    return new Failure(body.kind, body.message);
  }

  static gone(): Failure {
    return new Failure('gone', 'Faceprobe does not answer. Start `faceprobe serve` again, then reload this page.');
  }
}

export function sentenceOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
