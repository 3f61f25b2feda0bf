// The bytes of the bundles of web/dist, see runtime.h. The assembler includes files as they are; no compiler has to
// parse them as arrays.
#define BUNDLE(begin, end, file) .global begin; .global end; begin: .incbin file; end: .byte 0

    .section .rodata
    BUNDLE(imgeoPageBegin, imgeoPageEnd, IMGEO_PAGE_MODULE)
    BUNDLE(imgeoSharedBegin, imgeoSharedEnd, IMGEO_SHARED_MODULE)
    BUNDLE(imgeoSceneBegin, imgeoSceneEnd, IMGEO_SCENE_MODULE)
    BUNDLE(imgeoAnimationBegin, imgeoAnimationEnd, IMGEO_ANIMATION_MODULE)
    BUNDLE(imgeoWorkerBegin, imgeoWorkerEnd, IMGEO_WORKER_MODULE)
    BUNDLE(imgeoDecoderBegin, imgeoDecoderEnd, IMGEO_DECODER_MODULE)
    .section .note.GNU-stack,"",%progbits
