// The page's side of the worker. One question is asked at a time; cancelling ends the worker
// and starts another one with the module that is already compiled.

import type { Answers, Fault, FromWorker, Request, ToWorker } from "./protocol.js";

/** Why there is no answer. */
export class Refusal extends Error {
  constructor(readonly fault: Fault) {
    super(fault.message);
  }
}

const CANCELLED: Fault = {
  kind: "cancelled",
  message: "cancelled",
  item: undefined,
  index: [],
  location: undefined,
  least: undefined,
};

interface Pending {
  resolve(answer: unknown): void;
  reject(error: unknown): void;
}

export class Client {
  private worker: Worker | undefined;
  private module: Promise<WebAssembly.Module>;
  private readonly pending = new Map<number, Pending>();
  private last = 0;
  /** Told how far the work is, from 0 to 1 within a phase. */
  onprogress: (phase: string, part: number) => void = () => {};

  constructor(
    private readonly script: URL,
    wasm: URL,
  ) {
    this.module = compiled(wasm);
    this.start();
  }

  /** Whether a question is being worked on. */
  get busy(): boolean {
    return this.pending.size > 0;
  }

  ask<K extends Request["kind"]>(request: Request & { kind: K }): Promise<Answers[K]> {
    const worker = this.worker ?? this.start();
    const id = ++this.last;
    const answer = new Promise<unknown>((resolve, reject) => this.pending.set(id, { resolve, reject }));
    // If there is no module, whoever started the worker says so to all.
    void this.module.then(() => this.pending.has(id) && worker.postMessage({ id, request } satisfies ToWorker), () => {});
    return answer as Promise<Answers[K]>;
  }

  /** Ends all work at once. Meshes and sessions are gone. */
  cancel(): void {
    this.worker?.terminate();
    this.worker = undefined;
    this.refuseAll(CANCELLED);
    this.start();
  }

  private start(): Worker {
    const worker = new Worker(this.script, { type: "module", name: "hexdel" });
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.receive(data);
    worker.onerror = (event) => this.refuseAll({ ...CANCELLED, kind: "internal", message: event.message });
    this.worker = worker;
    this.module.then(
      (module) => worker.postMessage({ module } satisfies ToWorker),
      (error: unknown) => this.refuseAll({ ...CANCELLED, kind: "internal", message: `no module: ${String(error)}` }),
    );
    return worker;
  }

  private receive(message: FromWorker): void {
    if ("phase" in message) {
      this.onprogress(message.phase, message.total > 0 ? message.done / message.total : 0);
      return;
    }
    const pending = this.pending.get(message.id);
    this.pending.delete(message.id);
    if ("fault" in message) {
      pending?.reject(new Refusal(message.fault));
      if (message.fault.kind === "internal") {
        // Its memory cannot be trusted any more.
        this.cancel();
      }
    } else {
      pending?.resolve(message.answer);
    }
  }

  private refuseAll(fault: Fault): void {
    const all = [...this.pending.values()];
    this.pending.clear();
    all.forEach((pending) => pending.reject(new Refusal(fault)));
  }
}

/** Compiles a module, also of a server that does not know its type. */
async function compiled(wasm: URL): Promise<WebAssembly.Module> {
  const response = await fetch(wasm);
  if (!response.ok) {
    throw new Error(`${wasm.pathname}: ${response.status}`);
  }
  if (response.headers.get("content-type") === "application/wasm") {
    return WebAssembly.compileStreaming(response);
  }
  return WebAssembly.compile(await response.arrayBuffer());
}
