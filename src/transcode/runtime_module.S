// The bytes of the bundle named by IMGEO_RUNTIME_MODULE, see runtime.h. The
// assembler takes a file in as it is; no compiler has to parse it as an array.
    .section .rodata
    .global imgeoRuntimeBegin
    .global imgeoRuntimeEnd
imgeoRuntimeBegin:
    .incbin IMGEO_RUNTIME_MODULE
imgeoRuntimeEnd:
    .byte 0
    .section .note.GNU-stack,"",%progbits
