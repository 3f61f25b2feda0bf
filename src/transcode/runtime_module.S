// The bytes of the bundles named by IMGEO_RUNTIME_MODULE and IMGEO_WORKER_MODULE,
// see runtime.h. The assembler takes files in as they are; no compiler has to
// parse them as arrays.
    .section .rodata
    .global imgeoRuntimeBegin
    .global imgeoRuntimeEnd
    .global imgeoWorkerBegin
    .global imgeoWorkerEnd
imgeoRuntimeBegin:
    .incbin IMGEO_RUNTIME_MODULE
imgeoRuntimeEnd:
    .byte 0
imgeoWorkerBegin:
    .incbin IMGEO_WORKER_MODULE
imgeoWorkerEnd:
    .byte 0
    .section .note.GNU-stack,"",%progbits
